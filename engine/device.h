// The device that everything else is made from: picks a GPU, owns its queues, its memory and its pipeline cache.
// It outlives all that was made from it.
#pragma once

#include "engine/device_select.h"
#include "engine/instance.h"
#include "engine/memory.h"
#include "engine/pipeline.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace engine {

struct DeviceOptions {
    std::string select;                    // a part of the name or an index; empty: BRITTLE_DEVICE, else the best
    bool force_pooled_descriptors = false; // as if there were no push descriptors
    bool minimal = false;                  // nothing optional at all, as a host engine's device may be
    // All kernel libraries of this device share pipelines, which live as long as the device: for programs that make many
    // worlds or breaks one after the other. Without, a pipeline goes with the last that uses it.
    bool share_pipelines = false;
};

// A device that another has made, whose owner keeps it, and all it was made from, for longer than what is made from it here.
// What it was made with nobody can ask it: the owner says so.
struct ForeignDevice {
    PFN_vkGetInstanceProcAddr get_proc_addr = nullptr; // nullptr: that of this machine's loader
    VkInstance instance = VK_NULL_HANDLE;
    uint32_t api_version = 0; // that the instance was made for; Vulkan 1.1 is needed
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE; // of a family with compute
    uint32_t family = 0;
    bool long_integers = false; // shaderInt64 was enabled; it is needed
    OptionalFeatures enabled;   // of what is used when present, what was enabled
    // Where others use the queue as well: called before and after every use of it here, from the thread that uses it.
    void (*lock)(void* user) = nullptr;
    void (*unlock)(void* user) = nullptr;
    void* user = nullptr;
};

struct Queue {
    VkQueue handle = VK_NULL_HANDLE;
    uint32_t family = 0;
    uint32_t timestamp_bits = 0;
};

class Device {
public:
    // Opens a device of this machine. BRITTLE_DEVICE_WITHOUT in the environment lists optional features that it is opened
    // without (withoutFeatures), to rehearse a lesser device. Errors: Device; BadInput for a name in that list that is unknown.
    static Result<std::unique_ptr<Device>> create(const DeviceOptions& options = {});
    // Works on another's device. Errors: BadInput for handles that are none or do not belong together, Feature for what the
    // device lacks or was made without, by name.
    static Result<std::unique_ptr<Device>> adopt(const ForeignDevice& foreign);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const std::string& name() const { return info_.name; }
    const std::string& driver() const { return info_.driver; }
    bool isCpu() const { return info_.cpu; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
    const OptionalFeatures& features() const { return features_; }
    // Names of the extensions that it was opened with; none of a foreign device.
    const std::vector<std::string>& extensions() const { return extensions_; }
    bool hasPushDescriptors() const { return features_.push_descriptors; }
    uint32_t subgroupSize() const { return subgroup_.subgroupSize; }
    // VK_SUBGROUP_FEATURE_*, 0 where compute shaders have none.
    VkSubgroupFeatureFlags subgroupOperations() const;

    // A family of its own for compute where there is one, otherwise the same queue.
    const Queue& computeQueue() const { return compute_; }
    const Queue& graphicsQueue() const { return graphics_; }
    bool hasGraphics() const { return graphics_.handle != VK_NULL_HANDLE; }
    bool sharesQueueFamily() const { return compute_.family == graphics_.family; }

    // Somebody else made it, and destroys it.
    bool isForeign() const { return foreign_.device != VK_NULL_HANDLE; }
    VkDevice handle() const { return handle_; }
    const InstanceFunctions& instanceFunctions() const { return instance_vk_; }
    VkInstance instanceHandle() const { return isForeign() ? foreign_.instance : instance_->handle(); }
    uint32_t instanceVersion() const { return isForeign() ? foreign_.api_version : VK_API_VERSION_1_1; }
    VkPhysicalDevice physical() const { return physical_; }
    const VolkDeviceTable& vk() const { return table_; }
    VkPipelineCache pipelineCache() const { return pipeline_cache_; }
    SharedPipelines* sharedPipelines() { return shared_pipelines_.get(); } // nullptr where libraries have their own
    MemoryPool& memory() { return *memory_; }
    // Bytes that hosts have asked to be copied from the device to where they can read them, pictures left out.
    uint64_t readBackBytes() const { return read_back_bytes_; }
    void countReadBack(uint64_t bytes) { read_back_bytes_ += bytes; }

    // Safe from any thread; both queues may be one.
    Result<void> submit(const Queue& queue, VkCommandBuffer commands, VkFence fence);
    // For all that was submitted here; of a foreign device for all that its queue has.
    void waitIdle();

    // Errors and warnings of the validation layers about this device's instance; 0 without layers.
    uint32_t validationMessageCount() const { return instance_ ? instance_->validationMessageCount() : 0; }
    // The layer of Debian 12 (1.3.239) misreads push descriptors, and checks accesses against the end of the buffer rather
    // than of the view: push descriptors are left out, and arenas give every range a buffer of its own.
    bool gpuAssistedValidation() const { return gpuAssistedValidationIsOn(); }
    // For messages and captures; does nothing without the debug extension.
    void setName(VkObjectType type, uint64_t object, std::string_view name) const;
    bool hasDebugUtils() const { return instance_ && instance_->hasDebugUtils(); }

private:
    Device() = default;
    Result<void> open(const DeviceOptions& options);
    Result<void> openForeign();
    Result<void> chooseFeatures(const DeviceOptions& options);
    void readProperties();
    Result<void> createLogical();
    Result<void> createShared();
    std::vector<VkQueueFamilyProperties> queueFamilies() const;
    void pickFamilies();

    std::unique_ptr<Instance> instance_;
    ForeignDevice foreign_;
    InstanceFunctions instance_vk_;
    DeviceInfo info_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceSubgroupProperties subgroup_{};
    OptionalFeatures features_;
    std::vector<std::string> extensions_;
    Queue compute_, graphics_;
    VkDevice handle_ = VK_NULL_HANDLE;
    VolkDeviceTable table_{};
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
    std::unique_ptr<SharedPipelines> shared_pipelines_;
    std::unique_ptr<MemoryPool> memory_;
    uint64_t read_back_bytes_ = 0;
    std::mutex submit_mutex_;
};

// All devices of this machine, usable or not; empty where there is no Vulkan.
std::vector<DeviceInfo> listDevices();

} // namespace engine
