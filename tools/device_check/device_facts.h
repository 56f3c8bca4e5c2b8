// Reads the properties of a Vulkan device, as JSON.
#pragma once

#include "engine/device.h"

#include <nlohmann/json.hpp>

namespace device_check {

// The index of this device, as `brittle devices` lists it. Several devices may have the same name.
uint32_t indexOf(const engine::Device& device);

// Index, name, driver, versions, limits, subgroups, queue families, features, memory heaps and types, extensions.
nlohmann::ordered_json factsOf(const engine::Device& device);

} // namespace device_check
