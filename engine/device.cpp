#include "engine/device.h"

#include <cstdlib>

namespace engine {

namespace {

constexpr uint32_t kNoFamily = ~0u;

std::string wantedDevice(const DeviceOptions& options) {
    if (!options.select.empty()) return options.select;
    const char* environment = std::getenv("BRITTLE_DEVICE");
    return environment != nullptr ? environment : "";
}

// The first family that has all of `with` and none of `without`.
uint32_t findFamily(const std::vector<VkQueueFamilyProperties>& families, VkQueueFlags with, VkQueueFlags without) {
    for (uint32_t i = 0; i < families.size(); ++i) {
        const VkQueueFlags flags = families[i].queueFlags;
        if ((flags & with) == with && (flags & without) == 0) return i;
    }
    return kNoFamily;
}

} // namespace

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    std::unique_ptr<Device> device(new Device);
    if (auto opened = device->open(options); !opened) return opened.error();
    return device;
}

Result<void> Device::open(const DeviceOptions& options) {
    auto instance = Instance::create();
    if (!instance) return instance.error();
    instance_ = std::move(*instance);
    auto chosen = selectDevice(instance_->handle(), wantedDevice(options));
    if (!chosen) return chosen.error();
    physical_ = *chosen;

    info_ = describe(physical_, 0);
    subgroup_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup_, {}};
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    properties_ = properties.properties;
    minimal_ = options.minimal;
    if (!minimal_) features_ = optionalFeatures(physical_);
    if (options.force_pooled_descriptors || instance_->gpuAssistedValidation()) features_.push_descriptors = false;

    pickFamilies();
    if (auto made = createLogical(); !made) return made;
    memory_ = std::make_unique<MemoryPool>(*this);
    VkPipelineCacheCreateInfo cache{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    const VkResult cached = table_.vkCreatePipelineCache(handle_, &cache, nullptr, &pipeline_cache_);
    if (cached != VK_SUCCESS) return vulkanError("cannot create a pipeline cache", cached);
    return {};
}

void Device::pickFamilies() {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());

    compute_.family = findFamily(families, VK_QUEUE_COMPUTE_BIT, VK_QUEUE_GRAPHICS_BIT);
    if (compute_.family == kNoFamily) compute_.family = findFamily(families, VK_QUEUE_COMPUTE_BIT, 0);
    compute_.timestamp_bits = families[compute_.family].timestampValidBits;
    graphics_.family = findFamily(families, VK_QUEUE_GRAPHICS_BIT, 0);
    if (graphics_.family != kNoFamily) graphics_.timestamp_bits = families[graphics_.family].timestampValidBits;
}

Result<void> Device::createLogical() {
    const float priority = 1.0f;
    std::vector<VkDeviceQueueCreateInfo> queues;
    for (const uint32_t family : {compute_.family, graphics_.family}) {
        if (family == kNoFamily || (!queues.empty() && queues[0].queueFamilyIndex == family)) continue;
        queues.push_back({VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority});
    }
    std::vector<const char*> extensions;
    if (features_.push_descriptors) extensions.push_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    VkPhysicalDeviceFeatures enabled{};
    enabled.shaderInt64 = VK_TRUE;
    enabled.shaderFloat64 = features_.doubles ? VK_TRUE : VK_FALSE;
    enabled.multiDrawIndirect = features_.multi_draw_indirect ? VK_TRUE : VK_FALSE;
    enabled.drawIndirectFirstInstance = features_.draw_indirect_first_instance ? VK_TRUE : VK_FALSE;
    enabled.fragmentStoresAndAtomics = features_.shader_stores ? VK_TRUE : VK_FALSE;
    enabled.vertexPipelineStoresAndAtomics = enabled.fragmentStoresAndAtomics;

    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.queueCreateInfoCount = static_cast<uint32_t>(queues.size());
    info.pQueueCreateInfos = queues.data();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    info.pEnabledFeatures = &enabled;
    const VkResult made = vkCreateDevice(physical_, &info, nullptr, &handle_);
    if (made != VK_SUCCESS) return vulkanError("cannot open the device " + name(), made);
    volkLoadDeviceTable(&table_, handle_);
    table_.vkGetDeviceQueue(handle_, compute_.family, 0, &compute_.handle);
    if (graphics_.family != kNoFamily) table_.vkGetDeviceQueue(handle_, graphics_.family, 0, &graphics_.handle);
    return {};
}

Device::~Device() {
    if (handle_ == VK_NULL_HANDLE) return;
    table_.vkDeviceWaitIdle(handle_);
    if (pipeline_cache_ != VK_NULL_HANDLE) table_.vkDestroyPipelineCache(handle_, pipeline_cache_, nullptr);
    memory_.reset();
    table_.vkDestroyDevice(handle_, nullptr);
}

VkSubgroupFeatureFlags Device::subgroupOperations() const {
    return (subgroup_.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 ? subgroup_.supportedOperations : 0;
}

Result<void> Device::submit(const Queue& queue, VkCommandBuffer commands, VkFence fence) {
    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    const std::lock_guard lock(submit_mutex_);
    const VkResult submitted = table_.vkQueueSubmit(queue.handle, 1, &info, fence);
    if (submitted != VK_SUCCESS) return vulkanError("cannot submit to the device " + name(), submitted);
    return {};
}

void Device::waitIdle() {
    const std::lock_guard lock(submit_mutex_);
    table_.vkDeviceWaitIdle(handle_);
}

void Device::setName(VkObjectType type, uint64_t object, std::string_view name) const {
    if (!hasDebugUtils() || name.empty()) return;
    const std::string terminated(name);
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = terminated.c_str();
    vkSetDebugUtilsObjectNameEXT(handle_, &info);
}

std::vector<DeviceInfo> listDevices() {
    auto instance = Instance::create();
    if (!instance) return {};
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice device : physicalDevices((*instance)->handle()))
        infos.push_back(describe(device, static_cast<uint32_t>(infos.size())));
    return infos;
}

} // namespace engine
