#include "engine/kernel_twin.h"

#include "engine/commands.h"

namespace engine {

namespace {

constexpr VkDeviceSize kViewBytes = 256;

} // namespace

bool KernelTwin::helps(const Device& device) {
    return device.isCpu() && !device.isForeign() && !device.gpuAssistedValidation();
}

Result<std::unique_ptr<KernelTwin>> KernelTwin::create(const Device& of) {
    auto device = Device::create({.select = of.name()});
    if (!device) return device.error();
    auto buffer = Buffer::create(**device, (kMaxBindings + 1) * kViewBytes, BufferDomain::Device,
                                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, "kernel twin");
    if (!buffer) return buffer.error();
    return std::unique_ptr<KernelTwin>(new KernelTwin(std::move(*device), std::move(*buffer)));
}

// Dispatches no workgroup at all: the driver compiles before it looks at their number.
void KernelTwin::compile(KernelLibrary& library, std::string_view name, std::span<const uint32_t> spec) {
    const auto kernel = library.get(name, spec);
    if (!kernel) return;
    Commands commands(*device_);
    if (!commands.begin()) return;
    commands.fill(buffer_, 0);
    std::vector<BufferView> views;
    for (uint32_t k = 0; k < (*kernel)->bufferCount(); ++k)
        views.push_back(BufferView(buffer_).sub((k + 1) * kViewBytes, kViewBytes));
    const std::vector<std::byte> push((*kernel)->reflection.push_size);
    commands.dispatchIndirect(**kernel, BufferView(buffer_).sub(0, 12), push, views);
    static_cast<void>(commands.submitAndWait());
}

} // namespace engine
