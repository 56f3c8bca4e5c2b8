#include "engine/reload/ahead_compiler.h"

#include <algorithm>

namespace engine {

AheadCompilation::AheadCompilation(const Device& device, std::string name, KernelWords words,
                                   std::vector<Specialization> specializations)
    : device_(device), name_(std::move(name)), words_(std::move(words)), specializations_(std::move(specializations)) {
    if (!KernelTwin::helps(device)) return;
    const size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (size_t k = 0; k < std::min(cores, specializations_.size()); ++k)
        threads_.emplace_back([this] {
            try {
                work();
            } catch (...) { // what a thread throws ends the process, and nothing here is worth that
            }
        });
}

void AheadCompilation::work() {
    std::unique_ptr<KernelTwin> twin;
    const shaders::Module module{name_, *words_, {}, {}};
    for (size_t k = next_++; k < specializations_.size(); k = next_++) {
        if (!twin) {
            auto made = KernelTwin::create(device_);
            if (!made) return;
            twin = std::move(*made);
        }
        KernelLibrary library(twin->device(), {&module, 1}, specializations_[k]);
        twin->compile(library, name_);
    }
}

} // namespace engine
