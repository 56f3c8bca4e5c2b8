#include "tools/shader_reload/check_once.h"

#include "engine/reload/kernel_check.h"
#include "tools/brittle/progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

namespace shader_reload {
namespace {

using engine::CheckedKernel;
using engine::FolderKernel;

struct Tally {
    size_t refused = 0, other = 0, unknown = 0;
};

bool isAsBuilt(const FolderKernel& kernel, const CheckedKernel& checked) {
    return std::ranges::equal(*checked.words, kernel.host->words);
}

constexpr size_t kMostAlike = 8;

// Many kernels share a mistake in what they include: it is told once. And many may have one alike, as where a folder is gone.
void printMistakes(const std::vector<CheckedKernel>& checked) {
    std::set<std::string> told;
    std::map<std::string, size_t> alike; // by message
    for (const CheckedKernel& kernel : checked)
        for (const engine::Diagnostic& diagnostic : kernel.diagnostics)
            if (told.insert(textOf(diagnostic)).second && ++alike[diagnostic.message] <= kMostAlike)
                std::fprintf(stderr, "%s\n", textOf(diagnostic).c_str());
    for (const auto& [message, count] : alike)
        if (count > kMostAlike) std::fprintf(stderr, "and %zu more: %s\n", count - kMostAlike, message.c_str());
}

Tally tallyOf(const std::vector<FolderKernel>& kernels, const std::vector<CheckedKernel>& checked) {
    Tally tally;
    for (size_t k = 0; k < kernels.size(); ++k) {
        if (!checked[k].good())
            ++tally.refused;
        else if (kernels[k].host == nullptr)
            ++tally.unknown;
        else if (!isAsBuilt(kernels[k], checked[k]))
            ++tally.other;
    }
    return tally;
}

} // namespace

engine::Result<bool> checkOnce(const Options& options) {
    std::error_code error;
    if (!std::filesystem::is_directory(options.folder, error))
        return engine::Error{engine::ErrorCode::BadInput, options.folder.string() + ": is no folder"};
    const std::vector<FolderKernel> kernels = engine::kernelsIn(options.folder, shaders::all());
    if (kernels.empty())
        return engine::Error{engine::ErrorCode::BadInput,
                             options.folder.string() + ": has no kernels; there is no .comp, .vert or .frag in it"};
    const auto folders = options.include_folders.empty() ? std::vector{options.folder} : options.include_folders;
    const auto begun = std::chrono::steady_clock::now();
    const auto checked = engine::checkKernels(kernels, folders, [&](size_t done) {
        cli::showProgress("kernel " + std::to_string(done) + " of " + std::to_string(kernels.size()));
    });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    cli::clearProgress();
    printMistakes(checked);
    const Tally tally = tallyOf(kernels, checked);
    std::printf("%zu kernels in %.1f s: %zu sound, %zu refused", kernels.size(), took.count(), kernels.size() - tally.refused,
                tally.refused);
    if (tally.other > 0) std::printf("; %zu other than those built into this program", tally.other);
    if (tally.unknown > 0) std::printf("; %zu in no row of its table, so that no interface was compared", tally.unknown);
    std::printf("\n");
    return tally.refused == 0;
}

} // namespace shader_reload
