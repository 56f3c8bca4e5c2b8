// Lanes of a workgroup in kernels that run a lane an element: the host may choose.
#pragma once

#include "engine/result.h"
#include "engine/vulkan.h"

#include <cstdint>

namespace brittle {

// Errors: BadInput for what is no power of two from 8 to 256 or more than the device takes.
engine::Result<void> checkGroupSize(uint32_t size, const VkPhysicalDeviceLimits& limits);

} // namespace brittle
