#include "engine/device_features.h"

#include "engine/device_select.h"

#include <algorithm>
#include <array>
#include <spirv/unified1/spirv.hpp>

namespace engine {

namespace {

struct NamedFeature {
    std::string_view name;
    bool OptionalFeatures::*member;
};

constexpr std::array<NamedFeature, 7> kFeatures = {{
    {"push_descriptors", &OptionalFeatures::push_descriptors},
    {"multi_draw_indirect", &OptionalFeatures::multi_draw_indirect},
    {"draw_indirect_first_instance", &OptionalFeatures::draw_indirect_first_instance},
    {"driver_properties", &OptionalFeatures::driver_properties},
    {"doubles", &OptionalFeatures::doubles},
    {"shader_stores", &OptionalFeatures::shader_stores},
    {"subgroup_vote", &OptionalFeatures::subgroup_vote},
}};

// Every device with Vulkan 1.1 has the first two in compute shaders; missingRequirements asks for 64-bit integers.
constexpr std::array<uint32_t, 3> kRequired = {spv::CapabilityShader, spv::CapabilityGroupNonUniform, spv::CapabilityInt64};

struct OptionalCapability {
    uint32_t capability;
    bool OptionalFeatures::*member;
    const char* what;
};

constexpr std::array<OptionalCapability, 2> kOptional = {{
    {spv::CapabilityFloat64, &OptionalFeatures::doubles, "64-bit floats in shaders"},
    {spv::CapabilityGroupNonUniformVote, &OptionalFeatures::subgroup_vote, "subgroup votes in compute shaders"},
}};

bool votesInCompute(const InstanceFunctions& vk, VkPhysicalDevice device) {
    VkPhysicalDeviceSubgroupProperties subgroup{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &subgroup, {}};
    vk.vkGetPhysicalDeviceProperties2(device, &properties);
    return (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0 &&
           (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_VOTE_BIT) != 0;
}

std::string knownNames() {
    std::string names;
    for (const NamedFeature& feature : kFeatures)
        names += std::string(feature.name) + ", ";
    return names + "all";
}

} // namespace

OptionalFeatures optionalFeatures(const InstanceFunctions& vk, VkPhysicalDevice device) {
    VkPhysicalDeviceFeatures features;
    vk.vkGetPhysicalDeviceFeatures(device, &features);
    OptionalFeatures optional;
    optional.push_descriptors = hasExtension(vk, device, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
    optional.multi_draw_indirect = features.multiDrawIndirect == VK_TRUE;
    optional.draw_indirect_first_instance = features.drawIndirectFirstInstance == VK_TRUE;
    optional.driver_properties = hasExtension(vk, device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME);
    optional.doubles = features.shaderFloat64 == VK_TRUE;
    optional.shader_stores = features.fragmentStoresAndAtomics == VK_TRUE && features.vertexPipelineStoresAndAtomics == VK_TRUE;
    optional.subgroup_vote = votesInCompute(vk, device);
    return optional;
}

Result<OptionalFeatures> withoutFeatures(const OptionalFeatures& features, std::string_view list) {
    OptionalFeatures rest = features;
    while (!list.empty()) {
        const std::string_view name = list.substr(0, list.find(','));
        list.remove_prefix(std::min(list.size(), name.size() + 1));
        const auto named = std::ranges::find(kFeatures, name, &NamedFeature::name);
        if (named != kFeatures.end())
            rest.*named->member = false;
        else if (name == "all")
            rest = {};
        else
            return Error{ErrorCode::BadInput, "\"" + std::string(name) + "\" is no optional feature of a device; known are " +
                                                  knownNames() + ", separated by commas"};
    }
    return rest;
}

std::string lackingCapability(std::span<const uint32_t> capabilities, const OptionalFeatures& features) {
    for (const uint32_t capability : capabilities) {
        if (std::ranges::count(kRequired, capability) != 0) continue;
        const auto optional = std::ranges::find(kOptional, capability, &OptionalCapability::capability);
        if (optional == kOptional.end()) return "SPIR-V capability " + std::to_string(capability);
        if (!(features.*optional->member)) return optional->what;
    }
    return "";
}

} // namespace engine
