// A Vulkan instance and, where the debug extension is there, the ear that hears the validation layers.
#pragma once

#include "engine/instance_functions.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace engine {

class Instance {
public:
    // Layers come from the environment only: VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation VK_LAYER_ENABLES=...
    static Result<std::unique_ptr<Instance>> create();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return handle_; }
    PFN_vkGetInstanceProcAddr getProcAddr() const { return get_; }
    const InstanceFunctions& vk() const { return vk_; }
    bool hasDebugUtils() const { return messenger_ != VK_NULL_HANDLE; }
    uint32_t validationMessageCount() const { return validation_messages_; }

private:
    Instance() = default;
    void listen();
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

    PFN_vkGetInstanceProcAddr get_ = nullptr;
    InstanceFunctions vk_;
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::atomic<uint32_t> validation_messages_ = 0;
};

// Asked for by VK_LAYER_ENABLES.
bool gpuAssistedValidationIsOn();

// Errors and warnings of the validation layers since the process began, over all devices, also those destroyed since.
uint32_t validationMessageTotal();

} // namespace engine
