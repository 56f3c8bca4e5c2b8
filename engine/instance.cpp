#include "engine/instance.h"

#include "engine/loader_mutex.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace engine {

namespace {

std::atomic<uint32_t> total_messages = 0;

// What is asked of no instance.
template <class Function>
Function globalFunction(PFN_vkGetInstanceProcAddr get, const char* name) {
    return get == nullptr ? nullptr : reinterpret_cast<Function>(get(nullptr, name));
}

bool instanceHas(PFN_vkGetInstanceProcAddr get, const char* extension) {
    const auto list = globalFunction<PFN_vkEnumerateInstanceExtensionProperties>(get, "vkEnumerateInstanceExtensionProperties");
    if (list == nullptr) return false;
    uint32_t count = 0;
    list(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    list(nullptr, &count, properties.data());
    return std::ranges::any_of(properties, [&](const auto& p) { return std::strcmp(p.extensionName, extension) == 0; });
}

} // namespace

uint32_t validationMessageTotal() { return total_messages; }

Result<std::unique_ptr<Instance>> Instance::create() {
    const PFN_vkGetInstanceProcAddr get = loaderFunction();
    const auto version = globalFunction<PFN_vkEnumerateInstanceVersion>(get, "vkEnumerateInstanceVersion");
    uint32_t has = 0;
    if (version == nullptr || version(&has) != VK_SUCCESS || has < VK_API_VERSION_1_1) {
        return Error{ErrorCode::Device, "no Vulkan 1.1 loader on this machine (Debian: libvulkan1 mesa-vulkan-drivers)"};
    }
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "brittle";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    const char* debug_utils = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const bool debug = instanceHas(get, debug_utils);
    info.enabledExtensionCount = debug ? 1 : 0;
    info.ppEnabledExtensionNames = &debug_utils;

    std::unique_ptr<Instance> instance(new Instance);
    const auto create = globalFunction<PFN_vkCreateInstance>(get, "vkCreateInstance");
    {
        const std::lock_guard lock(loaderMutex());
        const VkResult made = create(&info, nullptr, &instance->handle_);
        if (made != VK_SUCCESS) return vulkanError("cannot create a Vulkan instance", made);
    }
    instance->get_ = get;
    instance->vk_ = loadInstanceFunctions(instance->handle_, get);
    if (debug) instance->listen();
    return instance;
}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE) vk_.vkDestroyDebugUtilsMessengerEXT(handle_, messenger_, nullptr);
    if (handle_ == VK_NULL_HANDLE) return;
    const std::lock_guard lock(loaderMutex());
    vk_.vkDestroyInstance(handle_, nullptr);
}

bool gpuAssistedValidationIsOn() {
    const char* layers = std::getenv("VK_LAYER_ENABLES");
    return layers != nullptr && std::strstr(layers, "GPU_ASSISTED") != nullptr;
}

void Instance::listen() {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = onMessage;
    info.pUserData = this;
    if (vk_.vkCreateDebugUtilsMessengerEXT(handle_, &info, nullptr, &messenger_) != VK_SUCCESS) messenger_ = VK_NULL_HANDLE;
}

VkBool32 Instance::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    const bool error = (severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0;
    std::fprintf(stderr, "validation %s: %s\n", error ? "error" : "warning", data->pMessage);
    ++static_cast<Instance*>(user)->validation_messages_;
    ++total_messages;
    return VK_FALSE;
}

} // namespace engine
