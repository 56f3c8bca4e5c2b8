#include "engine/instance_functions.h"

#include "engine/loader_mutex.h"

namespace engine {

namespace {

template <class Function>
void load(Function& function, VkInstance instance, PFN_vkGetInstanceProcAddr get, const char* name) {
    function = reinterpret_cast<Function>(get(instance, name));
}

} // namespace

InstanceFunctions loadInstanceFunctions(VkInstance instance, PFN_vkGetInstanceProcAddr get) {
    InstanceFunctions f;
    load(f.vkDestroyInstance, instance, get, "vkDestroyInstance");
    load(f.vkEnumeratePhysicalDevices, instance, get, "vkEnumeratePhysicalDevices");
    load(f.vkEnumerateDeviceExtensionProperties, instance, get, "vkEnumerateDeviceExtensionProperties");
    load(f.vkGetPhysicalDeviceFeatures, instance, get, "vkGetPhysicalDeviceFeatures");
    load(f.vkGetPhysicalDeviceProperties, instance, get, "vkGetPhysicalDeviceProperties");
    load(f.vkGetPhysicalDeviceProperties2, instance, get, "vkGetPhysicalDeviceProperties2");
    load(f.vkGetPhysicalDeviceMemoryProperties, instance, get, "vkGetPhysicalDeviceMemoryProperties");
    load(f.vkGetPhysicalDeviceQueueFamilyProperties, instance, get, "vkGetPhysicalDeviceQueueFamilyProperties");
    load(f.vkCreateDevice, instance, get, "vkCreateDevice");
    load(f.vkCreateDebugUtilsMessengerEXT, instance, get, "vkCreateDebugUtilsMessengerEXT");
    load(f.vkDestroyDebugUtilsMessengerEXT, instance, get, "vkDestroyDebugUtilsMessengerEXT");
    load(f.vkSetDebugUtilsObjectNameEXT, instance, get, "vkSetDebugUtilsObjectNameEXT");
    load(f.vkCmdBeginDebugUtilsLabelEXT, instance, get, "vkCmdBeginDebugUtilsLabelEXT");
    load(f.vkCmdEndDebugUtilsLabelEXT, instance, get, "vkCmdEndDebugUtilsLabelEXT");
    return f;
}

std::mutex& loaderMutex() {
    static std::mutex mutex;
    return mutex;
}

PFN_vkGetInstanceProcAddr loaderFunction() {
    const std::lock_guard lock(loaderMutex());
    static const bool found = volkInitialize() == VK_SUCCESS; // volk never closes the loader again
    return found ? vkGetInstanceProcAddr : nullptr;
}

void loadDeviceTable(VolkDeviceTable& table, VkInstance instance, PFN_vkGetInstanceProcAddr get, VkDevice device) {
    const std::lock_guard lock(loaderMutex());
    const PFN_vkGetDeviceProcAddr before = vkGetDeviceProcAddr;
    load(vkGetDeviceProcAddr, instance, get, "vkGetDeviceProcAddr");
    volkLoadDeviceTable(&table, device);
    vkGetDeviceProcAddr = before;
}

} // namespace engine
