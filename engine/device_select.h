// Which physical device, and why not the others.
#pragma once

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

// What a physical device offers of that which is used where present; nothing of it is needed.
struct OptionalFeatures {
    bool push_descriptors = false;             // else: pooled descriptor sets
    bool multi_draw_indirect = false;          // else: one call per draw command
    bool draw_indirect_first_instance = false; // else: no renderer
    bool driver_properties = false;            // else: a driver without a name
    bool doubles = false;                      // in shaders; else: kernels that name them are not loaded
    bool shader_stores = false;                // only the GPU-assisted validation wants it
};

// The one list of what is required of a device. Empty: it will do.
std::string missingRequirements(const InstanceFunctions& vk, VkPhysicalDevice device);

// The one list of what is used when present.
OptionalFeatures optionalFeatures(const InstanceFunctions& vk, VkPhysicalDevice device);

std::vector<VkPhysicalDevice> physicalDevices(const InstanceFunctions& vk, VkInstance instance);
DeviceInfo describe(const InstanceFunctions& vk, VkPhysicalDevice device, uint32_t index);

// By index, by a part of the name (case does not matter), or, with nothing asked, the fastest kind that is usable.
Result<VkPhysicalDevice> selectDevice(const InstanceFunctions& vk, VkInstance instance, std::string_view wanted);

} // namespace engine
