#include "engine/kernel_warmup.h"

#include "engine/commands.h"
#include "engine/device.h"

namespace engine {
namespace {

constexpr VkDeviceSize kViewBytes = 256;

// Dispatches no workgroup at all: the driver compiles before it looks at their number.
void dispatchNothing(Device& device, const Kernel& kernel, const Buffer& buffer) {
    Commands commands(device);
    if (!commands.begin()) return;
    commands.fill(buffer, 0);
    std::vector<BufferView> views;
    for (uint32_t k = 0; k < kernel.bufferCount(); ++k)
        views.push_back(BufferView(buffer).sub((k + 1) * kViewBytes, kViewBytes));
    const std::vector<std::byte> push(kernel.reflection.push_size);
    commands.dispatchIndirect(kernel, BufferView(buffer).sub(0, 12), push, views);
    static_cast<void>(commands.submitAndWait());
}

void compileOnTwin(const std::stop_token& stop, const std::string& name, std::span<const shaders::Module> modules,
                   const std::vector<SpecConstant>& common, const std::vector<std::string_view>& kernels) {
    auto twin = Device::create({.select = name});
    if (!twin) return;
    auto buffer = Buffer::create(**twin, (kMaxBindings + 1) * kViewBytes, BufferDomain::Device,
                                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "warm-up");
    if (!buffer) return;
    KernelLibrary library(**twin, modules, common);
    for (const std::string_view kernel : kernels) {
        if (stop.stop_requested()) return;
        if (auto made = library.get(kernel)) dispatchNothing(**twin, **made, *buffer);
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
    if (device.gpuAssistedValidation()) return;       // the layer's own work on every kernel would be done twice
    if (device.isCpu() && device.isForeign()) return; // a host has not asked for a second device in its process
    if (device.isCpu()) {
        thread_ = std::jthread([device_name = device.name(), modules = library.modules(), common = library.common(),
                                names = std::move(names)](const std::stop_token& stop) {
            quietly([&] { compileOnTwin(stop, device_name, modules, common, names); });
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
