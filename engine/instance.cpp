#include "engine/instance.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

namespace engine {

namespace {

std::atomic<uint32_t> total_messages = 0;

// volk keeps the functions of an instance in globals; all instances get the same ones from the loader.
std::mutex volk_mutex;

bool instanceHas(const char* extension) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, properties.data());
    return std::ranges::any_of(properties, [&](const auto& p) { return std::strcmp(p.extensionName, extension) == 0; });
}

// At exit the leak checker names who leaked, and cannot once the drivers have been unloaded: one instance keeps them.
void keepDriversForLeakChecker([[maybe_unused]] const VkInstanceCreateInfo& info) {
#ifdef __SANITIZE_ADDRESS__
    static VkInstance kept = VK_NULL_HANDLE;
    if (kept == VK_NULL_HANDLE) vkCreateInstance(&info, nullptr, &kept);
#endif
}

} // namespace

uint32_t validationMessageTotal() { return total_messages; }

Result<std::unique_ptr<Instance>> Instance::create() {
    const std::lock_guard lock(volk_mutex);
    if (volkInitialize() != VK_SUCCESS || volkGetInstanceVersion() < VK_API_VERSION_1_1) {
        return Error{ErrorCode::Device, "no Vulkan 1.1 loader on this machine (Debian: libvulkan1 mesa-vulkan-drivers)"};
    }
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "brittle";
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    const char* debug_utils = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const bool debug = instanceHas(debug_utils);
    info.enabledExtensionCount = debug ? 1 : 0;
    info.ppEnabledExtensionNames = &debug_utils;

    std::unique_ptr<Instance> instance(new Instance);
    const VkResult made = vkCreateInstance(&info, nullptr, &instance->handle_);
    if (made != VK_SUCCESS) return vulkanError("cannot create a Vulkan instance", made);
    keepDriversForLeakChecker(info);
    volkLoadInstanceOnly(instance->handle_);
    if (debug) instance->listen();
    return instance;
}

Instance::~Instance() {
    if (messenger_ != VK_NULL_HANDLE) vkDestroyDebugUtilsMessengerEXT(handle_, messenger_, nullptr);
    if (handle_ != VK_NULL_HANDLE) vkDestroyInstance(handle_, nullptr);
}

bool Instance::gpuAssistedValidation() const {
    const char* layers = std::getenv("VK_LAYER_ENABLES");
    return layers != nullptr && std::strstr(layers, "GPU_ASSISTED") != nullptr;
}

void Instance::listen() {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = onMessage;
    info.pUserData = this;
    if (vkCreateDebugUtilsMessengerEXT(handle_, &info, nullptr, &messenger_) != VK_SUCCESS) messenger_ = VK_NULL_HANDLE;
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
