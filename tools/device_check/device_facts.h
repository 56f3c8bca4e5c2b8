// Reads the properties of a Vulkan device, as JSON.
#pragma once

#include "engine/device.h"

#include <nlohmann/json.hpp>

namespace device_check {

// Name, driver, versions, limits, subgroups, queue families, features, memory heaps and types, extensions.
nlohmann::ordered_json factsOf(const engine::Device& device);

} // namespace device_check
