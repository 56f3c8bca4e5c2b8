// The functions of an instance that the engine calls, from whoever handed the instance out. volk's own table is one for the
// whole process: two instances of different loaders would overwrite each other's.
#pragma once

#include "engine/vulkan.h"

namespace engine {

struct InstanceFunctions {
    PFN_vkDestroyInstance vkDestroyInstance = nullptr;
    PFN_vkEnumeratePhysicalDevices vkEnumeratePhysicalDevices = nullptr;
    PFN_vkEnumerateDeviceExtensionProperties vkEnumerateDeviceExtensionProperties = nullptr;
    PFN_vkGetPhysicalDeviceFeatures vkGetPhysicalDeviceFeatures = nullptr;
    PFN_vkGetPhysicalDeviceProperties vkGetPhysicalDeviceProperties = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 vkGetPhysicalDeviceProperties2 = nullptr; // none of an instance for Vulkan 1.0
    PFN_vkGetPhysicalDeviceMemoryProperties vkGetPhysicalDeviceMemoryProperties = nullptr;
    PFN_vkGetPhysicalDeviceQueueFamilyProperties vkGetPhysicalDeviceQueueFamilyProperties = nullptr;
    PFN_vkCreateDevice vkCreateDevice = nullptr;
    // Of the debug extension, where the instance has it.
    PFN_vkCreateDebugUtilsMessengerEXT vkCreateDebugUtilsMessengerEXT = nullptr;
    PFN_vkDestroyDebugUtilsMessengerEXT vkDestroyDebugUtilsMessengerEXT = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT vkSetDebugUtilsObjectNameEXT = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT vkCmdBeginDebugUtilsLabelEXT = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT vkCmdEndDebugUtilsLabelEXT = nullptr;
};

InstanceFunctions loadInstanceFunctions(VkInstance instance, PFN_vkGetInstanceProcAddr get);

// The Vulkan loader of this machine, opened at run time and kept; nullptr where there is none. Safe from any thread.
PFN_vkGetInstanceProcAddr loaderFunction();

// Safe from any thread, though volk finds devices' functions through a global.
void loadDeviceTable(VolkDeviceTable& table, VkInstance instance, PFN_vkGetInstanceProcAddr get, VkDevice device);

} // namespace engine
