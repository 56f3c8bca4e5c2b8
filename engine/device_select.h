// Which physical device, and why not the others.
#pragma once

#include "engine/device_features.h"
#include "engine/instance_functions.h"

#include <string>
#include <string_view>
#include <vector>

namespace engine {

struct DeviceInfo {
    uint32_t index = 0; // what BRITTLE_DEVICE and --device take, beside a part of the name
    std::string name;
    std::string driver;
    bool cpu = false;
    bool usable = false;
    std::string why_not; // what it lacks, where it is not usable
};

// The one list of what is required of a device. Empty: it will do.
std::string missingRequirements(const InstanceFunctions& vk, VkPhysicalDevice device);

bool hasExtension(const InstanceFunctions& vk, VkPhysicalDevice device, const char* extension);

std::vector<VkPhysicalDevice> physicalDevices(const InstanceFunctions& vk, VkInstance instance);
DeviceInfo describe(const InstanceFunctions& vk, VkPhysicalDevice device, uint32_t index);

// By index, by a part of the name (case does not matter), or, with nothing asked, the fastest kind that is usable.
Result<VkPhysicalDevice> selectDevice(const InstanceFunctions& vk, VkInstance instance, std::string_view wanted);

} // namespace engine
