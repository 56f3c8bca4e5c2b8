// Descriptor sets for devices without push descriptors: one per dispatch, from pools that grow and are reset together.
#pragma once

#include "engine/vulkan.h"

#include <vector>

namespace engine {

class Device;

class DescriptorPools {
public:
    explicit DescriptorPools(Device& device) : device_(device) {}
    ~DescriptorPools();
    DescriptorPools(const DescriptorPools&) = delete;
    DescriptorPools& operator=(const DescriptorPools&) = delete;

    Result<VkDescriptorSet> allocate(VkDescriptorSetLayout layout, uint32_t buffers);
    // Only when the device no longer uses any set.
    void reset();

private:
    Result<void> nextPool();

    Device& device_;
    std::vector<VkDescriptorPool> pools_;
    size_t current_ = 0;     // pool that is being filled
    uint32_t sets_left_ = 0; // in it
    uint32_t buffers_left_ = 0;
};

} // namespace engine
