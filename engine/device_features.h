// Features that Brittle uses if a device has them and replaces if it has not.
#pragma once

#include "engine/instance_functions.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace engine {

struct OptionalFeatures {
    bool push_descriptors = false;             // otherwise pooled descriptor sets
    bool multi_draw_indirect = false;          // otherwise one call per draw command
    bool draw_indirect_first_instance = false; // otherwise no renderer
    bool driver_properties = false;            // otherwise a driver without a name
    bool doubles = false;                      // 64-bit floats in shaders; otherwise kernels that use them are not loaded
    bool shader_stores = false;                // only GPU-assisted validation needs it
    bool subgroup_vote = false;                // in compute shaders; otherwise kernels NAME_no_vote
};

// Returns which of these features a physical device has. The device must have Vulkan 1.1.
OptionalFeatures optionalFeatures(const InstanceFunctions& vk, VkPhysicalDevice device);

// Returns `features` with those in `list` set to false. `list` holds names of the members above, separated by commas, or "all".
// Errors: BadInput for an unknown name; the message lists the known ones.
Result<OptionalFeatures> withoutFeatures(const OptionalFeatures& features, std::string_view list);

// Returns what a SPIR-V module that declares `capabilities` needs and a device with `features` lacks, for example "64-bit
// floats in shaders". Empty: the device can load it. A capability that is neither required of every device nor optional is
// returned by its number.
std::string lackingCapability(std::span<const uint32_t> capabilities, const OptionalFeatures& features);

} // namespace engine
