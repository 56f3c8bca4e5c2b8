#include "engine/buffer.h"

#include "engine/device.h"

#include <utility>

namespace engine {

namespace {

struct MemoryKind {
    VkMemoryPropertyFlags required, preferred;
};

MemoryKind kindOf(BufferDomain domain) {
    const VkMemoryPropertyFlags host = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (domain) {
    case BufferDomain::Upload: return {host, 0};
    case BufferDomain::Readback: return {host, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    default: return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    }
}

} // namespace

Result<Buffer> Buffer::create(Device& device, VkDeviceSize size, BufferDomain domain, VkBufferUsageFlags usage,
                              std::string_view name) {
    if (size == 0) return Error{ErrorCode::Internal, "buffer \"" + std::string(name) + "\" of 0 bytes"};
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    Buffer buffer;
    buffer.device_ = &device;
    buffer.size_ = size;
    buffer.usage_ = info.usage;
    buffer.name_ = name;
    const VolkDeviceTable& vk = device.vk();
    const VkResult made = vk.vkCreateBuffer(device.handle(), &info, nullptr, &buffer.handle_);
    if (made != VK_SUCCESS) return vulkanError("buffer \"" + buffer.name_ + "\" of " + std::to_string(size) + " bytes", made);

    VkMemoryRequirements needs;
    vk.vkGetBufferMemoryRequirements(device.handle(), buffer.handle_, &needs);
    const MemoryKind kind = kindOf(domain);
    auto memory = device.memory().take(needs, kind.required, kind.preferred);
    if (!memory) return memory.error();
    buffer.memory_ = *memory;
    const VkResult bound = vk.vkBindBufferMemory(device.handle(), buffer.handle_, memory->block->handle, memory->offset);
    if (bound != VK_SUCCESS) return vulkanError("memory of buffer \"" + buffer.name_ + "\"", bound);
    if (domain != BufferDomain::Device) buffer.mapped_ = memory->mapped();
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer.handle_), name);
    return buffer;
}

void Buffer::destroy() {
    if (handle_ != VK_NULL_HANDLE) device_->vk().vkDestroyBuffer(device_->handle(), handle_, nullptr);
    if (memory_.block != nullptr) device_->memory().giveBack(memory_);
}

void Buffer::swap(Buffer& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    std::swap(size_, other.size_);
    std::swap(usage_, other.usage_);
    std::swap(memory_, other.memory_);
    std::swap(mapped_, other.mapped_);
    std::swap(name_, other.name_);
}

} // namespace engine
