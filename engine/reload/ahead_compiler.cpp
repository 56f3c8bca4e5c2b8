#include "engine/reload/ahead_compiler.h"

#include "engine/kernels_ahead.h"

namespace engine {
namespace {

void compileAll(const Device& device, const std::string& name, const KernelWords& words,
                std::vector<Specialization> specializations) {
    const shaders::Module module{name, *words, {}, {}};
    std::vector<KernelAhead> kernels;
    for (Specialization& constants : specializations)
        kernels.push_back({name, std::move(constants)});
    compileAhead(device, {&module, 1}, kernels, {});
}

} // namespace

AheadCompilation::AheadCompilation(const Device& device, std::string name, KernelWords words,
                                   std::vector<Specialization> specializations) {
    if (specializations.empty()) return;
    thread_ = std::jthread([&device, name = std::move(name), words = std::move(words), all = std::move(specializations)] {
        try {
            compileAll(device, name, words, all);
        } catch (...) { // what a thread throws ends the process, and nothing here is worth that
        }
    });
}

} // namespace engine
