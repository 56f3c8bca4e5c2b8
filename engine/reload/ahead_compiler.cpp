#include "engine/reload/ahead_compiler.h"

namespace engine {

void AheadCompiler::compile(const std::string& name, const KernelWords& words,
                            std::span<const std::vector<SpecConstant>> specializations) {
    if (!helps_ || specializations.empty()) return;
    if (!twin_) {
        auto made = KernelTwin::create(device_);
        helps_ = made.has_value();
        if (!helps_) return;
        twin_ = std::move(*made);
    }
    const shaders::Module module{name, *words, {}, {}};
    for (const std::vector<SpecConstant>& constants : specializations) {
        KernelLibrary library(twin_->device(), {&module, 1}, constants);
        twin_->compile(library, name);
    }
}

} // namespace engine
