// Device memory in a few large blocks, from which buffers take their share.
#pragma once

#include "engine/vulkan.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace engine {

class Device;

struct MemoryBlock {
    VkDeviceMemory handle = VK_NULL_HANDLE;
    uint32_t type = 0;
    VkDeviceSize size = 0;
    std::byte* mapped = nullptr;               // the whole block, where the host can see it
    std::map<VkDeviceSize, VkDeviceSize> free; // offset to length, never touching each other
};

struct MemoryShare {
    MemoryBlock* block = nullptr;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;

    std::byte* mapped() const { return block->mapped == nullptr ? nullptr : block->mapped + offset; }
};

class MemoryPool {
public:
    explicit MemoryPool(Device& device);
    ~MemoryPool();
    MemoryPool(const MemoryPool&) = delete;
    MemoryPool& operator=(const MemoryPool&) = delete;

    // Memory that has all of `required`, and of `preferred` if there is such. Safe from any thread.
    Result<MemoryShare> take(const VkMemoryRequirements& needs, VkMemoryPropertyFlags required,
                             VkMemoryPropertyFlags preferred);
    void giveBack(const MemoryShare& share);

    VkDeviceSize allocatedBytes() const; // in all blocks, used or not
    VkDeviceSize takenBytes() const;     // of these, what buffers and images have
    Result<uint32_t> pickType(uint32_t allowed, VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred) const;

private:
    Result<MemoryBlock*> addBlock(uint32_t type, VkDeviceSize size);

    Device& device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    mutable std::mutex mutex_;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

} // namespace engine
