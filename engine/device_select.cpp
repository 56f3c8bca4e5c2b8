#include "engine/device_select.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>

namespace engine {

bool hasExtension(const InstanceFunctions& vk, VkPhysicalDevice device, const char* extension) {
    uint32_t count = 0;
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, properties.data());
    return std::ranges::any_of(properties, [&](const auto& p) { return std::strcmp(p.extensionName, extension) == 0; });
}

namespace {

constexpr uint32_t kRequiredStorageBuffers = 16;
constexpr uint32_t kRequiredPushBytes = 128;

bool hasComputeQueue(const InstanceFunctions& vk, VkPhysicalDevice device) {
    uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    return std::ranges::any_of(families, [](const auto& f) { return (f.queueFlags & VK_QUEUE_COMPUTE_BIT) != 0; });
}

std::string driverOf(const InstanceFunctions& vk, VkPhysicalDevice device) {
    if (!hasExtension(vk, device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) return "";
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver, {}};
    vk.vkGetPhysicalDeviceProperties2(device, &properties);
    return std::string(driver.driverName) + " " + driver.driverInfo;
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::optional<uint32_t> asIndex(std::string_view text) {
    uint32_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return index;
}

// Lower is better.
int rank(const InstanceFunctions& vk, VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vk.vkGetPhysicalDeviceProperties(device, &properties);
    switch (properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return 2;
    default: return 3;
    }
}

std::string listed(const std::vector<DeviceInfo>& devices) {
    if (devices.empty()) return "; this machine has no Vulkan device at all";
    std::string text = "; this machine has";
    for (const DeviceInfo& d : devices) {
        text += (&d == &devices.front() ? " device " : ", device ") + std::to_string(d.index) + ", " + d.name;
        text += d.usable ? " (usable)" : " (not usable: " + d.why_not + ")";
    }
    return text;
}

bool matches(const DeviceInfo& device, std::string_view wanted) {
    if (const auto index = asIndex(wanted)) return device.index == *index;
    return lower(device.name).find(lower(wanted)) != std::string::npos;
}

} // namespace

std::string missingRequirements(const InstanceFunctions& vk, VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vk.vkGetPhysicalDeviceProperties(device, &properties);
    VkPhysicalDeviceFeatures features;
    vk.vkGetPhysicalDeviceFeatures(device, &features);
    std::string missing;
    const auto require = [&](bool present, const char* what) {
        if (!present) missing += (missing.empty() ? "lacks " : ", ") + std::string(what);
    };
    require(properties.apiVersion >= VK_API_VERSION_1_1, "Vulkan 1.1");
    require(hasComputeQueue(vk, device), "a compute queue");
    require(features.shaderInt64 == VK_TRUE, "64-bit integers in shaders");
    require(properties.limits.maxPerStageDescriptorStorageBuffers >= kRequiredStorageBuffers, "16 storage buffers per stage");
    require(properties.limits.maxPushConstantsSize >= kRequiredPushBytes, "128 bytes of push constants");
    return missing;
}

std::vector<VkPhysicalDevice> physicalDevices(const InstanceFunctions& vk, VkInstance instance) {
    uint32_t count = 0;
    vk.vkEnumeratePhysicalDevices(instance, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    vk.vkEnumeratePhysicalDevices(instance, &count, devices.data());
    return devices;
}

DeviceInfo describe(const InstanceFunctions& vk, VkPhysicalDevice device, uint32_t index) {
    VkPhysicalDeviceProperties properties;
    vk.vkGetPhysicalDeviceProperties(device, &properties);
    DeviceInfo info;
    info.index = index;
    info.name = properties.deviceName;
    info.driver = driverOf(vk, device);
    info.cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    info.why_not = missingRequirements(vk, device);
    info.usable = info.why_not.empty();
    return info;
}

Result<VkPhysicalDevice> selectDevice(const InstanceFunctions& vk, VkInstance instance, std::string_view wanted) {
    const std::vector<VkPhysicalDevice> devices = physicalDevices(vk, instance);
    std::vector<DeviceInfo> infos;
    for (uint32_t i = 0; i < devices.size(); ++i)
        infos.push_back(describe(vk, devices[i], i));

    std::optional<uint32_t> best;
    for (const DeviceInfo& info : infos) {
        if (!info.usable || (!wanted.empty() && !matches(info, wanted))) continue;
        if (!best || rank(vk, devices[info.index]) < rank(vk, devices[*best])) best = info.index;
    }
    if (best) return devices[*best];
    const std::string what = wanted.empty() ? "no usable device" : "no usable device matches \"" + std::string(wanted) + "\"";
    return Error{ErrorCode::Device, what + listed(infos)};
}

} // namespace engine
