#include "engine/descriptors.h"

#include "engine/device.h"

namespace engine {

namespace {

constexpr uint32_t kSetsPerPool = 256;
constexpr uint32_t kBuffersPerPool = kSetsPerPool * 8;

} // namespace

DescriptorPools::~DescriptorPools() {
    for (VkDescriptorPool pool : pools_)
        device_.vk().vkDestroyDescriptorPool(device_.handle(), pool, nullptr);
}

Result<VkDescriptorSet> DescriptorPools::allocate(VkDescriptorSetLayout layout, uint32_t buffers) {
    if (sets_left_ == 0 || buffers_left_ < buffers) {
        if (auto next = nextPool(); !next) return next.error();
    }
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pools_[current_];
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult made = device_.vk().vkAllocateDescriptorSets(device_.handle(), &info, &set);
    if (made != VK_SUCCESS) return vulkanError("descriptor set", made);
    --sets_left_;
    buffers_left_ -= buffers;
    return set;
}

void DescriptorPools::reset() {
    for (VkDescriptorPool pool : pools_)
        device_.vk().vkResetDescriptorPool(device_.handle(), pool, 0);
    current_ = 0;
    sets_left_ = pools_.empty() ? 0 : kSetsPerPool;
    buffers_left_ = pools_.empty() ? 0 : kBuffersPerPool;
}

Result<void> DescriptorPools::nextPool() {
    if (pools_.empty() || current_ + 1 == pools_.size()) {
        const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBuffersPerPool};
        VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
        info.maxSets = kSetsPerPool;
        info.poolSizeCount = 1;
        info.pPoolSizes = &size;
        VkDescriptorPool pool = VK_NULL_HANDLE;
        const VkResult made = device_.vk().vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool);
        if (made != VK_SUCCESS) return vulkanError("descriptor pool", made);
        pools_.push_back(pool);
        current_ = pools_.size() - 1;
    } else {
        ++current_;
    }
    sets_left_ = kSetsPerPool;
    buffers_left_ = kBuffersPerPool;
    return {};
}

} // namespace engine
