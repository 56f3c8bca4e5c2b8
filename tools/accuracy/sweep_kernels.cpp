// The kernels that a sweep runs, in all versions of them, compiled before anything is measured: on all cores, where a CPU's
// driver would compile one after the other, as they are met.
#include "engine/kernels_ahead.h"
#include "engine/reflection.h"
#include "shaders-spirv/shared/effects.h"
#include "shaders-spirv/shared/fracture.h"
#include "tools/accuracy/sweep.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

namespace accuracy {
namespace {

using engine::KernelAhead;
using engine::SpecConstant;

constexpr uint32_t kPassId = 0; // of kernels that count in one pass and fill in another

// What a setting or a scene of the sweep gives to a constant.
struct Choices {
    uint32_t id;
    std::vector<uint32_t> values;
};

// Rare cells and faces, and searches, that are met at exact precision alone; and mappings that are not tried in doubles.
constexpr std::array<std::string_view, 4> kExactOnly = {"cut_cells_tree", "cut_cells_exact_medium", "cut_cells_exact_large",
                                                        "cap_faces_huge"};
constexpr std::array<std::string_view, 2> kNotInDoubles = {"cut_cells_edges", "cut_cells_linear"};
constexpr std::string_view kInDoubles = "_double";

bool isIn(std::span<const std::string_view> names, std::string_view name) { return std::ranges::count(names, name) != 0; }

bool isNeverMetInDoubles(std::string_view name) {
    if (!name.ends_with(kInDoubles)) return false;
    name.remove_suffix(kInDoubles.size());
    return isIn(kExactOnly, name) || isIn(kNotInDoubles, name);
}

// No setting and no scene calls for these. Whatever is wrong here costs time and nothing else: what is left out is compiled
// when it is met, what is not, for nothing.
bool isNeverMet(const shaders::Module& module) {
    return module.file.starts_with("effects/") || module.file.starts_with("draw/") || module.name.ends_with("_wide") ||
           module.name.find("strikes") != std::string_view::npos || module.name.find("_no_vote") != std::string_view::npos ||
           isNeverMetInDoubles(module.name);
}

bool isMetInFloats(std::string_view name) {
    return shaders::find(std::string(name) + std::string(kInDoubles)) != nullptr && !isIn(kExactOnly, name);
}

std::vector<Choices> choicesFor(const shaders::Module& module, uint32_t group_size) {
    std::vector<uint32_t> precisions = {PRECISION_EXACT};
    if (isMetInFloats(module.name)) precisions.push_back(PRECISION_FAST);
    return {{kPassId, {0, 1}},     {PRECISION_ID, std::move(precisions)},
            {CONTACTS_ID, {1}},    {FRICTION_ID, {1}},
            {CCD_ID, {1, 0}},      {DRAG_ID, {0}},
            {SIBLINGS_ID, {0, 1}}, {FLAT_SIZE_ID, {group_size}}};
}

// Every combination of what the constants that it declares may be.
std::vector<std::vector<SpecConstant>> versionsOf(const shaders::Module& module, std::span<const uint32_t> declared,
                                                  uint32_t group_size) {
    std::vector<std::vector<SpecConstant>> versions = {{}};
    for (const Choices& choices : choicesFor(module, group_size)) {
        if (!std::ranges::binary_search(declared, choices.id)) continue;
        std::vector<std::vector<SpecConstant>> more;
        for (const auto& version : versions)
            for (const uint32_t value : choices.values) {
                more.push_back(version);
                more.back().push_back({choices.id, value});
            }
        versions = std::move(more);
    }
    return versions;
}

// Long ones first, so that no core is left with one when the others are done.
std::vector<KernelAhead> kernelsOfSweep(uint32_t group_size) {
    std::vector<shaders::Module> modules(shaders::all().begin(), shaders::all().end());
    std::ranges::stable_sort(modules, std::ranges::greater(), [](const shaders::Module& m) { return m.words.size(); });
    std::vector<KernelAhead> kernels;
    for (const shaders::Module& module : modules) {
        const auto reflection = engine::reflect(module.words);
        if (!reflection || reflection->stage != engine::ShaderStage::Compute || isNeverMet(module)) continue;
        for (auto& version : versionsOf(module, reflection->spec_ids, group_size))
            kernels.push_back({module.name, std::move(version)});
    }
    return kernels;
}

} // namespace

engine::Result<void> compileKernels(Sweep& sweep) {
    const uint32_t wanted = sweep.options.group_size;
    const std::vector<KernelAhead> kernels = kernelsOfSweep(wanted == 0 ? GROUP_SIZE : wanted);
    engine::compileAhead(sweep.device, shaders::all(), kernels, [&](size_t begun) {
        sweep.progress.show(std::to_string(begun) + " of " + std::to_string(kernels.size()), 0);
    });
    return {};
}

} // namespace accuracy
