// Vulkan through volk: the loader is opened at run time, and every device has its own table of functions.
#pragma once

#include "engine/result.h"

#include <string>
#include <volk.h>

namespace engine {

// "vkCreateBuffer: VK_ERROR_OUT_OF_DEVICE_MEMORY"
Error vulkanError(std::string_view what, VkResult result);

} // namespace engine
