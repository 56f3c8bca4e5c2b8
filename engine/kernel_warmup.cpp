#include "engine/kernel_warmup.h"

#include "engine/device.h"
#include "engine/kernel_twin.h"

namespace engine {
namespace {

// What libraries share somebody else has asked for, and compiles.
void compileOnTwin(const std::stop_token& stop, const Device& device, const KernelLibrary& of,
                   std::vector<std::string_view> kernels) {
    std::erase_if(kernels, [&](std::string_view kernel) { return of.isShared(kernel); });
    if (kernels.empty()) return;
    auto twin = KernelTwin::create(device);
    if (!twin) return;
    KernelLibrary library((*twin)->device(), of.modules(), of.common());
    for (const std::string_view kernel : kernels) {
        if (stop.stop_requested()) return;
        (*twin)->compile(library, kernel);
    }
}

// What a thread throws ends the process, and nothing here is worth that: whoever asks for the kernel finds out.
template <class Work>
void quietly(Work&& work) {
    try {
        work();
    } catch (...) {
    }
}

} // namespace

KernelWarmup::KernelWarmup(Device& device, KernelLibrary& library, std::vector<std::string_view> names) {
    if (device.isCpu() && !KernelTwin::helps(device)) return;
    if (device.gpuAssistedValidation()) return; // as there
    if (device.isCpu()) {
        thread_ = std::jthread([&device, &library, names = std::move(names)](const std::stop_token& stop) mutable {
            quietly([&] { compileOnTwin(stop, device, library, std::move(names)); });
        });
        return;
    }
    thread_ = std::jthread([&library, names = std::move(names)] {
        std::vector<KernelRequest> requests;
        for (const std::string_view name : names)
            requests.push_back({name, {}});
        quietly([&] { static_cast<void>(library.warm(requests)); });
    });
}

void KernelWarmup::finish() {
    if (thread_.joinable()) thread_.join();
}

} // namespace engine
