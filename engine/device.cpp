#include "engine/device.h"

#include "engine/loader_mutex.h"
#include "engine/unchecked_kernels.h"

#include <cstdlib>
#include <optional>

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

// The queue of a host that uses it as well, for as long as this lives.
class QueueLock {
public:
    explicit QueueLock(const ForeignDevice& foreign) : foreign_(foreign) {
        if (foreign_.lock != nullptr) foreign_.lock(foreign_.user);
    }
    ~QueueLock() {
        if (foreign_.unlock != nullptr) foreign_.unlock(foreign_.user);
    }
    QueueLock(const QueueLock&) = delete;
    QueueLock& operator=(const QueueLock&) = delete;

private:
    const ForeignDevice& foreign_;
};

Error missing(const std::string& what) { return {ErrorCode::Feature, "the host's Vulkan device cannot be used: " + what}; }

// What is needed of the device beyond what its physical device can.
std::optional<Error> unfitFor(const ForeignDevice& foreign) {
    if (foreign.instance == VK_NULL_HANDLE || foreign.physical == VK_NULL_HANDLE || foreign.device == VK_NULL_HANDLE ||
        foreign.queue == VK_NULL_HANDLE)
        return Error{ErrorCode::BadInput, "instance, physical device, device and queue are needed, all four"};
    if ((foreign.lock == nullptr) != (foreign.unlock == nullptr))
        return Error{ErrorCode::BadInput, "a queue is locked and unlocked: give both functions or neither"};
    if (foreign.api_version < VK_API_VERSION_1_1)
        return missing("its instance was made for Vulkan 1.0; ask for 1.1 in VkApplicationInfo::apiVersion");
    if (!foreign.long_integers) return missing("it was made without the feature shaderInt64; enable it in vkCreateDevice");
    return std::nullopt;
}

} // namespace

Result<std::unique_ptr<Device>> Device::adopt(const ForeignDevice& foreign) {
    if (const auto unfit = unfitFor(foreign)) return *unfit;
    std::unique_ptr<Device> device(new Device);
    device->foreign_ = foreign;
    if (auto opened = device->openForeign(); !opened) return opened.error();
    return device;
}

Result<void> Device::openForeign() {
    if (foreign_.get_proc_addr == nullptr) foreign_.get_proc_addr = loaderFunction();
    if (foreign_.get_proc_addr == nullptr)
        return Error{ErrorCode::Device, "no Vulkan loader on this machine; give the host's vkGetInstanceProcAddr"};
    instance_vk_ = loadInstanceFunctions(foreign_.instance, foreign_.get_proc_addr);
    if (instance_vk_.vkGetPhysicalDeviceProperties2 == nullptr)
        return missing("its instance has not the functions of Vulkan 1.1");
    physical_ = foreign_.physical;
    if (const std::string lacks = missingRequirements(instance_vk_, physical_); !lacks.empty()) return missing("it " + lacks);
    const auto families = queueFamilies();
    if (foreign_.family >= families.size() || (families[foreign_.family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
        return Error{ErrorCode::BadInput, "queue family " + std::to_string(foreign_.family) + " has no compute"};
    readProperties();
    features_ = foreign_.enabled;
    // Hosts enable nothing for it.
    features_.subgroup_vote = optionalFeatures(instance_vk_, physical_).subgroup_vote;
    if (gpuAssistedValidationIsOn()) features_.push_descriptors = false;
    handle_ = foreign_.device;
    compute_ = {foreign_.queue, foreign_.family, families[foreign_.family].timestampValidBits};
    if ((families[foreign_.family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) graphics_ = compute_;
    loadDeviceTable(table_, foreign_.instance, foreign_.get_proc_addr, handle_);
    if (features_.push_descriptors && table_.vkCmdPushDescriptorSetKHR == nullptr)
        return missing("it is said to have VK_KHR_push_descriptor, and was made without");
    return createShared();
}

Result<std::unique_ptr<Device>> Device::create(const DeviceOptions& options) {
    std::unique_ptr<Device> device(new Device);
    if (auto opened = device->open(options); !opened) return opened.error();
    return device;
}

Result<void> Device::open(const DeviceOptions& options) {
    auto instance = Instance::create();
    if (!instance) return instance.error();
    instance_ = std::move(*instance);
    instance_vk_ = instance_->vk();
    auto chosen = selectDevice(instance_vk_, instance_->handle(), wantedDevice(options));
    if (!chosen) return chosen.error();
    physical_ = *chosen;
    readProperties();
    if (options.share_pipelines) shared_pipelines_ = std::make_unique<SharedPipelines>();
    if (auto chose = chooseFeatures(options); !chose) return chose;

    pickFamilies();
    if (auto made = createLogical(); !made) return made;
    return createShared();
}

Result<void> Device::chooseFeatures(const DeviceOptions& options) {
    if (!options.minimal) features_ = optionalFeatures(instance_vk_, physical_);
    if (options.force_pooled_descriptors || gpuAssistedValidationIsOn()) features_.push_descriptors = false;
    const char* without = std::getenv("BRITTLE_DEVICE_WITHOUT");
    if (without == nullptr) return {};
    auto rest = withoutFeatures(features_, without);
    if (!rest) return Error{rest.error().code, "BRITTLE_DEVICE_WITHOUT: " + rest.error().message};
    features_ = *rest;
    return {};
}

void Device::readProperties() {
    info_ = describe(instance_vk_, physical_, 0);
    subgroup_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup_, {}};
    instance_vk_.vkGetPhysicalDeviceProperties2(physical_, &properties);
    properties_ = properties.properties;
}

Result<void> Device::createShared() {
    memory_ = std::make_unique<MemoryPool>(*this);
    VkPipelineCacheCreateInfo cache{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    const VkResult cached = table_.vkCreatePipelineCache(handle_, &cache, nullptr, &pipeline_cache_);
    if (cached != VK_SUCCESS) return vulkanError("cannot create a pipeline cache", cached);
    return {};
}

std::vector<VkQueueFamilyProperties> Device::queueFamilies() const {
    uint32_t count = 0;
    instance_vk_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance_vk_.vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
    return families;
}

void Device::pickFamilies() {
    const auto families = queueFamilies();
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
    if (features_.push_descriptors) extensions_.emplace_back(VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    const auto for_unchecked = extensionsForUncheckedKernels();
    extensions_.insert(extensions_.end(), for_unchecked.begin(), for_unchecked.end());
    std::vector<const char*> extensions;
    for (const std::string& extension : extensions_)
        extensions.push_back(extension.c_str());
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
    VkPhysicalDeviceGraphicsPipelineLibraryFeaturesEXT code_in_pipelines{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_GRAPHICS_PIPELINE_LIBRARY_FEATURES_EXT, nullptr, VK_TRUE};
    if (!for_unchecked.empty()) info.pNext = &code_in_pipelines;
    const VkResult made = [&] {
        const std::lock_guard lock(loaderMutex());
        return instance_vk_.vkCreateDevice(physical_, &info, nullptr, &handle_);
    }();
    if (made != VK_SUCCESS) return vulkanError("cannot open the device " + name(), made);
    loadDeviceTable(table_, instance_->handle(), instance_->getProcAddr(), handle_);
    table_.vkGetDeviceQueue(handle_, compute_.family, 0, &compute_.handle);
    if (graphics_.family != kNoFamily) table_.vkGetDeviceQueue(handle_, graphics_.family, 0, &graphics_.handle);
    return {};
}

Device::~Device() {
    if (handle_ == VK_NULL_HANDLE) return;
    waitIdle();
    shared_pipelines_.reset();
    if (pipeline_cache_ != VK_NULL_HANDLE) table_.vkDestroyPipelineCache(handle_, pipeline_cache_, nullptr);
    memory_.reset();
    if (isForeign()) return;
    const std::lock_guard lock(loaderMutex());
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
    const QueueLock with_host(foreign_);
    const VkResult submitted = table_.vkQueueSubmit(queue.handle, 1, &info, fence);
    if (submitted != VK_SUCCESS) return vulkanError("cannot submit to the device " + name(), submitted);
    return {};
}

void Device::waitIdle() {
    const std::lock_guard lock(submit_mutex_);
    if (!isForeign()) {
        table_.vkDeviceWaitIdle(handle_);
        return;
    }
    // Of all its queues the device may only be waited for by who has all of them.
    const QueueLock with_host(foreign_);
    table_.vkQueueWaitIdle(compute_.handle);
}

void Device::setName(VkObjectType type, uint64_t object, std::string_view name) const {
    if (!hasDebugUtils() || name.empty()) return;
    const std::string terminated(name);
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = terminated.c_str();
    instance_vk_.vkSetDebugUtilsObjectNameEXT(handle_, &info);
}

std::vector<DeviceInfo> listDevices() {
    auto instance = Instance::create();
    if (!instance) return {};
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice device : physicalDevices((*instance)->vk(), (*instance)->handle()))
        infos.push_back(describe((*instance)->vk(), device, static_cast<uint32_t>(infos.size())));
    return infos;
}

} // namespace engine
