#include "engine/memory.h"

#include "engine/device.h"

#include <algorithm>
#include <optional>

namespace engine {

namespace {

constexpr VkDeviceSize kBlockBytes = VkDeviceSize(32) << 20;

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) { return (value + alignment - 1) / alignment * alignment; }

// First fit.
std::optional<VkDeviceSize> takeFrom(MemoryBlock& block, VkDeviceSize size, VkDeviceSize alignment) {
    for (auto it = block.free.begin(); it != block.free.end(); ++it) {
        const auto [begin, length] = *it;
        const VkDeviceSize offset = alignUp(begin, alignment), end = begin + length;
        if (offset + size > end) continue;
        block.free.erase(it);
        if (offset > begin) block.free[begin] = offset - begin;
        if (end > offset + size) block.free[offset + size] = end - offset - size;
        return offset;
    }
    return std::nullopt;
}

void returnTo(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize size) {
    auto next = block.free.lower_bound(offset);
    if (next != block.free.end() && next->first == offset + size) {
        size += next->second;
        next = block.free.erase(next);
    }
    if (next != block.free.begin()) {
        auto before = std::prev(next);
        if (before->first + before->second == offset) {
            before->second += size;
            return;
        }
    }
    block.free[offset] = size;
}

} // namespace

MemoryPool::MemoryPool(Device& device) : device_(device) {
    device.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties_);
}

MemoryPool::~MemoryPool() {
    for (const auto& block : blocks_)
        device_.vk().vkFreeMemory(device_.handle(), block->handle, nullptr);
}

Result<uint32_t> MemoryPool::pickType(uint32_t allowed, VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred) const {
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
            if ((allowed >> i & 1u) != 0 && (flags & wanted) == wanted) return i;
        }
    }
    return Error{ErrorCode::Device, "the device " + device_.name() + " has no memory of the kind asked for"};
}

Result<MemoryBlock*> MemoryPool::addBlock(uint32_t type, VkDeviceSize size) {
    auto block = std::make_unique<MemoryBlock>();
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, size, type};
    const VkResult made = device_.vk().vkAllocateMemory(device_.handle(), &info, nullptr, &block->handle);
    if (made != VK_SUCCESS) return vulkanError("cannot allocate " + std::to_string(size) + " bytes on " + device_.name(), made);
    block->type = type;
    block->size = size;
    block->free[0] = size;
    if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0) {
        void* mapped = nullptr;
        const VkResult seen = device_.vk().vkMapMemory(device_.handle(), block->handle, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (seen == VK_SUCCESS) block->mapped = static_cast<std::byte*>(mapped);
    }
    blocks_.push_back(std::move(block));
    return blocks_.back().get();
}

Result<MemoryShare> MemoryPool::take(const VkMemoryRequirements& needs, VkMemoryPropertyFlags required,
                                     VkMemoryPropertyFlags preferred) {
    const std::lock_guard lock(mutex_);
    const auto type = pickType(needs.memoryTypeBits, required, preferred);
    if (!type) return type.error();
    for (const auto& block : blocks_) {
        if (block->type != *type) continue;
        if (const auto offset = takeFrom(*block, needs.size, needs.alignment))
            return MemoryShare{block.get(), *offset, needs.size};
    }
    auto block = addBlock(*type, std::max(kBlockBytes, needs.size));
    if (!block) return block.error();
    const auto offset = takeFrom(**block, needs.size, needs.alignment);
    ENGINE_ASSERT(offset.has_value());
    return MemoryShare{*block, *offset, needs.size};
}

void MemoryPool::giveBack(const MemoryShare& share) {
    const std::lock_guard lock(mutex_);
    MemoryBlock* block = share.block;
    returnTo(*block, share.offset, share.size);
    const bool empty = block->free.size() == 1 && block->free.begin()->second == block->size;
    if (!empty || block->size <= kBlockBytes) return;
    // Blocks of a single large buffer go back to the driver at once; the small ones are kept for the next buffers.
    device_.vk().vkFreeMemory(device_.handle(), block->handle, nullptr);
    std::erase_if(blocks_, [&](const auto& b) { return b.get() == block; });
}

VkDeviceSize MemoryPool::allocatedBytes() const {
    const std::lock_guard lock(mutex_);
    VkDeviceSize total = 0;
    for (const auto& block : blocks_)
        total += block->size;
    return total;
}

VkDeviceSize MemoryPool::takenBytes() const {
    const std::lock_guard lock(mutex_);
    VkDeviceSize total = 0;
    for (const auto& block : blocks_) {
        total += block->size;
        for (const auto& [offset, length] : block->free)
            total -= length;
    }
    return total;
}

} // namespace engine
