#include "tools/device_check/device_facts.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace device_check {
namespace {

using Json = nlohmann::ordered_json;

struct FlagName {
    uint32_t flag;
    const char* name;
};

Json namesOf(uint32_t flags, std::initializer_list<FlagName> known) {
    Json names = Json::array();
    for (const FlagName& f : known)
        if ((flags & f.flag) != 0) names.push_back(f.name);
    return names;
}

std::string versionOf(uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

Json limitsOf(const VkPhysicalDeviceLimits& l) {
    return {{"max_compute_workgroup_count", l.maxComputeWorkGroupCount},
            {"max_compute_workgroup_size", l.maxComputeWorkGroupSize},
            {"max_compute_workgroup_invocations", l.maxComputeWorkGroupInvocations},
            {"max_compute_shared_memory_bytes", l.maxComputeSharedMemorySize},
            {"max_storage_buffer_bytes", l.maxStorageBufferRange},
            {"max_storage_buffers_per_stage", l.maxPerStageDescriptorStorageBuffers},
            {"max_push_constant_bytes", l.maxPushConstantsSize},
            {"max_memory_allocations", l.maxMemoryAllocationCount},
            {"min_storage_buffer_alignment", l.minStorageBufferOffsetAlignment},
            {"buffer_image_granularity", l.bufferImageGranularity},
            {"non_coherent_atom_bytes", l.nonCoherentAtomSize},
            {"timestamp_period_ns", l.timestampPeriod}};
}

Json subgroupsOf(const engine::Device& device) {
    return {{"size", device.subgroupSize()},
            {"in_compute", namesOf(device.subgroupOperations(), {{VK_SUBGROUP_FEATURE_BASIC_BIT, "basic"},
                                                                 {VK_SUBGROUP_FEATURE_VOTE_BIT, "vote"},
                                                                 {VK_SUBGROUP_FEATURE_ARITHMETIC_BIT, "arithmetic"},
                                                                 {VK_SUBGROUP_FEATURE_BALLOT_BIT, "ballot"},
                                                                 {VK_SUBGROUP_FEATURE_SHUFFLE_BIT, "shuffle"},
                                                                 {VK_SUBGROUP_FEATURE_CLUSTERED_BIT, "clustered"},
                                                                 {VK_SUBGROUP_FEATURE_QUAD_BIT, "quad"}})}};
}

Json queuesOf(const engine::Device& device) {
    uint32_t count = 0;
    device.instanceFunctions().vkGetPhysicalDeviceQueueFamilyProperties(device.physical(), &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    device.instanceFunctions().vkGetPhysicalDeviceQueueFamilyProperties(device.physical(), &count, families.data());
    Json list = Json::array();
    for (uint32_t k = 0; k < count; ++k)
        list.push_back({{"queues", families[k].queueCount},
                        {"can", namesOf(families[k].queueFlags, {{VK_QUEUE_GRAPHICS_BIT, "graphics"},
                                                                 {VK_QUEUE_COMPUTE_BIT, "compute"},
                                                                 {VK_QUEUE_TRANSFER_BIT, "transfer"},
                                                                 {VK_QUEUE_SPARSE_BINDING_BIT, "sparse binding"}})},
                        {"timestamp_bits", families[k].timestampValidBits},
                        {"used_for_compute", k == device.computeQueue().family}});
    return list;
}

Json featuresOf(const engine::Device& device) {
    VkPhysicalDeviceFeatures has;
    device.instanceFunctions().vkGetPhysicalDeviceFeatures(device.physical(), &has);
    const engine::OptionalFeatures& used = device.features();
    return {{"shader_int64", has.shaderInt64 == VK_TRUE},
            {"shader_float64", has.shaderFloat64 == VK_TRUE},
            {"shader_int16", has.shaderInt16 == VK_TRUE},
            {"robust_buffer_access", has.robustBufferAccess == VK_TRUE},
            {"sparse_residency_buffer", has.sparseResidencyBuffer == VK_TRUE},
            {"push_descriptors", used.push_descriptors},
            {"multi_draw_indirect", used.multi_draw_indirect},
            {"draw_indirect_first_instance", used.draw_indirect_first_instance}};
}

Json memoryOf(const engine::Device& device) {
    VkPhysicalDeviceMemoryProperties memory;
    device.instanceFunctions().vkGetPhysicalDeviceMemoryProperties(device.physical(), &memory);
    Json heaps = Json::array(), types = Json::array();
    for (uint32_t k = 0; k < memory.memoryHeapCount; ++k)
        heaps.push_back({{"bytes", memory.memoryHeaps[k].size},
                         {"device_local", (memory.memoryHeaps[k].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0}});
    for (uint32_t k = 0; k < memory.memoryTypeCount; ++k)
        types.push_back(
            {{"heap", memory.memoryTypes[k].heapIndex},
             {"is", namesOf(memory.memoryTypes[k].propertyFlags, {{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "device local"},
                                                                  {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT, "host visible"},
                                                                  {VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, "coherent"},
                                                                  {VK_MEMORY_PROPERTY_HOST_CACHED_BIT, "cached"}})}});
    return {{"heaps", heaps}, {"types", types}};
}

Json extensionsOf(const engine::Device& device) {
    uint32_t count = 0;
    const auto list = device.instanceFunctions().vkEnumerateDeviceExtensionProperties;
    list(device.physical(), nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    list(device.physical(), nullptr, &count, properties.data());
    Json names = Json::array();
    for (const VkExtensionProperties& p : properties)
        names.push_back(p.extensionName);
    return names;
}

// BRITTLE_DEVICE_WITHOUT: optional features that the device has, and that are not used.
std::string leftOut() {
    const char* names = std::getenv("BRITTLE_DEVICE_WITHOUT");
    return names == nullptr ? "" : names;
}

} // namespace

uint32_t indexOf(const engine::Device& device) {
    const auto all = engine::physicalDevices(device.instanceFunctions(), device.instanceHandle());
    return static_cast<uint32_t>(std::ranges::find(all, device.physical()) - all.begin());
}

Json factsOf(const engine::Device& device) {
    VkPhysicalDeviceProperties properties;
    device.instanceFunctions().vkGetPhysicalDeviceProperties(device.physical(), &properties);
    return {{"index", indexOf(device)},
            {"name", device.name()},
            {"driver", device.driver()},
            {"is_cpu", device.isCpu()},
            {"vulkan", versionOf(properties.apiVersion)},
            {"vendor_id", properties.vendorID},
            {"device_id", properties.deviceID},
            {"driver_version", properties.driverVersion},
            {"limits", limitsOf(properties.limits)},
            {"subgroups", subgroupsOf(device)},
            {"queue_families", queuesOf(device)},
            {"features", featuresOf(device)},
            {"opened_without", leftOut()},
            {"memory", memoryOf(device)},
            {"extensions", extensionsOf(device)}};
}

} // namespace device_check
