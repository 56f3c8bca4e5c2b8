#include "tests/abi/host_device.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace abi_test {
namespace {

void must(bool good, const char* what) {
    if (good) return;
    std::fprintf(stderr, "host: %s failed\n", what);
    std::exit(EXIT_FAILURE);
}

bool hasDebugUtils(PFN_vkGetInstanceProcAddr get) {
    const auto list =
        reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(get(nullptr, "vkEnumerateInstanceExtensionProperties"));
    uint32_t count = 0;
    list(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> properties(count);
    list(nullptr, &count, properties.data());
    return std::ranges::any_of(
        properties, [](const auto& p) { return std::strcmp(p.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0; });
}

} // namespace

HostDevice::HostDevice(const HostOptions& options) : made_with_(options) {
    get_ = engine::loaderFunction();
    must(get_ != nullptr, "finding a Vulkan loader");
    createInstance(options);
    createDevice(options);
}

HostDevice::~HostDevice() {
    table_.vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE) functions_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    functions_.vkDestroyInstance(instance_, nullptr);
}

void HostDevice::createInstance(const HostOptions& options) {
    VkApplicationInfo app{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    app.apiVersion = options.one_dot_zero ? VK_API_VERSION_1_0 : VK_API_VERSION_1_1;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &app;
    const char* debug = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const bool has_debug = hasDebugUtils(get_);
    info.enabledExtensionCount = has_debug ? 1 : 0;
    info.ppEnabledExtensionNames = &debug;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(get_(nullptr, "vkCreateInstance"));
    must(create(&info, nullptr, &instance_) == VK_SUCCESS, "vkCreateInstance");
    functions_ = engine::loadInstanceFunctions(instance_, get_);
    if (!has_debug) return;
    VkDebugUtilsMessengerCreateInfoEXT ear{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    ear.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    ear.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    ear.pfnUserCallback = onMessage;
    ear.pUserData = this;
    must(functions_.vkCreateDebugUtilsMessengerEXT(instance_, &ear, nullptr, &messenger_) == VK_SUCCESS, "listening");
}

void HostDevice::createDevice(const HostOptions& options) {
    uint32_t count = 1;
    must(functions_.vkEnumeratePhysicalDevices(instance_, &count, &physical_) >= 0 && count == 1, "finding a device");
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features{};
    features.shaderInt64 = options.long_integers ? VK_TRUE : VK_FALSE;
    const char* push = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    info.enabledExtensionCount = options.push_descriptors ? 1 : 0;
    info.ppEnabledExtensionNames = &push;
    must(functions_.vkCreateDevice(physical_, &info, nullptr, &device_) == VK_SUCCESS, "vkCreateDevice");
    engine::loadDeviceTable(table_, instance_, get_, device_);
    table_.vkGetDeviceQueue(device_, 0, 0, &queue_);
}

BrittleVulkan HostDevice::vulkan() const {
    BrittleVulkan v = brittleDefaultContextDef().vulkan;
    v.instance = instance_;
    v.physical_device = physical_;
    v.device = device_;
    v.queue = queue_;
    v.api_version = made_with_.one_dot_zero ? VK_API_VERSION_1_0 : VK_API_VERSION_1_1;
    v.features = (made_with_.long_integers ? uint32_t{BRITTLE_FEATURE_SHADER_INT64} : 0u) |
                 (made_with_.push_descriptors ? uint32_t{BRITTLE_FEATURE_PUSH_DESCRIPTOR} : 0u);
    v.queue_user = const_cast<HostDevice*>(this);
    v.lock_queue = [](void* user) {
        static_cast<HostDevice*>(user)->queue_mutex_.lock();
        ++static_cast<HostDevice*>(user)->locked_;
    };
    v.unlock_queue = [](void* user) { static_cast<HostDevice*>(user)->queue_mutex_.unlock(); };
    return v;
}

void HostDevice::submit(const std::function<void(VkCommandBuffer)>& record) {
    VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkCommandPool pool = VK_NULL_HANDLE;
    must(table_.vkCreateCommandPool(device_, &pool_info, nullptr, &pool) == VK_SUCCESS, "vkCreateCommandPool");
    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = pool;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    must(table_.vkAllocateCommandBuffers(device_, &allocate, &commands) == VK_SUCCESS, "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    table_.vkBeginCommandBuffer(commands, &begin);
    record(commands);
    must(table_.vkEndCommandBuffer(commands) == VK_SUCCESS, "vkEndCommandBuffer");
    VkFence fence = VK_NULL_HANDLE;
    const VkFenceCreateInfo fence_info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    must(table_.vkCreateFence(device_, &fence_info, nullptr, &fence) == VK_SUCCESS, "vkCreateFence");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    {
        const std::lock_guard lock(queue_mutex_);
        must(table_.vkQueueSubmit(queue_, 1, &submit, fence) == VK_SUCCESS, "vkQueueSubmit");
    }
    must(table_.vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX) == VK_SUCCESS, "vkWaitForFences");
    table_.vkDestroyFence(device_, fence, nullptr);
    table_.vkDestroyCommandPool(device_, pool, nullptr);
}

std::vector<std::byte> HostDevice::read(VkBuffer buffer, uint64_t offset, uint64_t bytes) {
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer target = VK_NULL_HANDLE;
    must(table_.vkCreateBuffer(device_, &info, nullptr, &target) == VK_SUCCESS, "vkCreateBuffer");
    VkMemoryRequirements needs;
    table_.vkGetBufferMemoryRequirements(device_, target, &needs);
    VkPhysicalDeviceMemoryProperties kinds;
    functions_.vkGetPhysicalDeviceMemoryProperties(physical_, &kinds);
    constexpr VkMemoryPropertyFlags kWanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    uint32_t type = 0;
    while (type < kinds.memoryTypeCount &&
           ((needs.memoryTypeBits >> type & 1u) == 0 || (kinds.memoryTypes[type].propertyFlags & kWanted) != kWanted))
        ++type;
    VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    must(table_.vkAllocateMemory(device_, &allocate, nullptr, &memory) == VK_SUCCESS, "vkAllocateMemory");
    table_.vkBindBufferMemory(device_, target, memory, 0);
    submit([&](VkCommandBuffer commands) {
        const VkBufferCopy region{offset, 0, bytes};
        table_.vkCmdCopyBuffer(commands, buffer, target, 1, &region);
        const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                      VK_ACCESS_HOST_READ_BIT};
        table_.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                                    nullptr, 0, nullptr);
    });
    void* mapped = nullptr;
    must(table_.vkMapMemory(device_, memory, 0, bytes, 0, &mapped) == VK_SUCCESS, "vkMapMemory");
    std::vector<std::byte> result(bytes);
    std::memcpy(result.data(), mapped, bytes);
    table_.vkDestroyBuffer(device_, target, nullptr);
    table_.vkFreeMemory(device_, memory, nullptr);
    return result;
}

VkBool32 HostDevice::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    ++static_cast<HostDevice*>(user)->messages_;
    return VK_FALSE;
}

} // namespace abi_test
