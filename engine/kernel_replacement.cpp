// How another version of a kernel takes the place of the one that runs: made while that one goes on running, put in its place
// between two recordings, all at once.
#include "engine/kernel.h"
#include "engine/kernel_interface.h"

#include <algorithm>

namespace engine {

Result<KernelReplacement> KernelLibrary::prepare(std::string_view name, KernelWords words) {
    const auto module = std::ranges::find(modules_, name, &shaders::Module::name);
    if (module == modules_.end()) return Error{ErrorCode::Internal, "no kernel is named \"" + std::string(name) + "\""};
    const auto host = reflect(module->words), now = reflect(*words);
    if (!host) return host.error();
    if (!now) return now.error();
    if (const auto changes = interfaceChanges(*host, *now); !changes.empty())
        return Error{ErrorCode::BadInput, "kernel \"" + std::string(name) + "\": " + changes[0].why};
    KernelReplacement replacement{std::string(name), std::move(words), {}};
    if (auto made = complete(replacement); !made) return made.error();
    return replacement;
}

Result<void> KernelLibrary::complete(KernelReplacement& replacement) {
    for (const auto& [key, kernel] : kernelsNamed(replacement.name)) {
        if (replacement.pipelines.contains(key.second)) continue;
        auto pipeline = makePipeline(*kernel, *replacement.words);
        if (!pipeline) return pipeline.error();
        replacement.pipelines.emplace(key.second, std::move(*pipeline));
    }
    return {};
}

// Specializations that somebody asks for meanwhile are made first, too.
Result<void> KernelLibrary::adopt(std::span<KernelReplacement> replacements) {
    for (;;) {
        for (KernelReplacement& replacement : replacements)
            if (auto made = complete(replacement); !made) return made;
        const std::lock_guard lock(mutex_);
        if (!std::ranges::all_of(replacements, [&](const auto& replacement) { return covers(replacement); })) continue;
        for (const KernelReplacement& replacement : replacements)
            install(replacement);
        return {};
    }
}

bool KernelLibrary::covers(const KernelReplacement& replacement) const {
    return std::ranges::all_of(kernels_, [&](const auto& made) {
        return made.first.first != replacement.name || replacement.pipelines.contains(made.first.second);
    });
}

void KernelLibrary::install(const KernelReplacement& replacement) {
    replaced_[replacement.name] = replacement.words;
    for (auto& [key, kernel] : kernels_)
        if (key.first == replacement.name) kernel->pipeline = replacement.pipelines.at(key.second);
}

bool KernelLibrary::has(std::string_view name) const { return !kernelsNamed(name).empty(); }

std::vector<std::vector<SpecConstant>> KernelLibrary::specializationsOf(std::string_view name) const {
    std::vector<std::vector<SpecConstant>> all;
    for (const auto& [key, kernel] : kernelsNamed(name))
        all.push_back(kernel->constants);
    return all;
}

std::vector<std::pair<KernelLibrary::Key, const Kernel*>> KernelLibrary::kernelsNamed(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    std::vector<std::pair<Key, const Kernel*>> named;
    for (const auto& [key, kernel] : kernels_)
        if (key.first == name) named.emplace_back(key, kernel.get());
    return named;
}

} // namespace engine
