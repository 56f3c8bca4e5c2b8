// A Vulkan device as a host makes it, with what the host likes to have, and the validation layers' messages about it.
#pragma once

#include "engine/instance_functions.h"
#include "modules/brittle/brittle.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace abi_test {

struct HostOptions {
    bool long_integers = true;     // shaderInt64
    bool push_descriptors = false; // if the machine's device has them
    bool one_dot_zero = false;     // an instance for Vulkan 1.0
};

class HostDevice {
public:
    explicit HostDevice(const HostOptions& options = {}); // ends the program where there is no Vulkan
    ~HostDevice();
    HostDevice(const HostDevice&) = delete;
    HostDevice& operator=(const HostDevice&) = delete;

    BrittleVulkan vulkan() const; // with locks
    const VolkDeviceTable& vk() const { return table_; }
    VkDevice handle() const { return device_; }
    uint32_t family() const { return 0; }
    uint32_t messages() const { return messages_; } // errors and warnings so far
    uint32_t locked() const { return locked_; }     // how often the queue was

    // Records, submits under the lock, and waits.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    // So many bytes of a buffer of Brittle's.
    std::vector<std::byte> read(VkBuffer buffer, uint64_t offset, uint64_t bytes);

private:
    void createInstance(const HostOptions& options);
    void createDevice(const HostOptions& options);
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

    PFN_vkGetInstanceProcAddr get_ = nullptr;
    engine::InstanceFunctions functions_;
    VolkDeviceTable table_{};
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    HostOptions made_with_;
    std::atomic<uint32_t> messages_ = 0;
    std::mutex queue_mutex_;
    std::atomic<uint32_t> locked_ = 0;
};

} // namespace abi_test
