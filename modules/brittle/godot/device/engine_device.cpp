#include "modules/brittle/godot/device/engine_device.h"

#include "modules/brittle/godot/interface/value.h"

#include <bit>

namespace brittle_godot {
namespace {

// RenderingDevice.DriverResource
constexpr int kLogicalDevice = 0, kPhysicalDevice = 1, kTopmostObject = 2, kCommandQueue = 3, kQueueFamily = 4;

// The engine's instance is of this version or a newer one, it does not say which. Of its device's features it enables 64-bit
// integers wherever there are any, which Brittle checks, and push descriptors never.
constexpr uint32_t kVulkan11 = 1u << 22 | 1u << 12;

uint64_t resource(const Value& rendering_device, int which) {
    const Value id = rendering_device.call("get_driver_resource", {which, Value::empty(Type::Rid), 0});
    return static_cast<uint64_t>(id.asInt());
}

template <class Handle>
Handle handleOf(const Value& rendering_device, int which) {
    return std::bit_cast<Handle>(resource(rendering_device, which));
}

} // namespace

std::optional<BrittleVulkan> engineVulkan(std::string& why) {
    const Value server = singleton("RenderingServer");
    const Value device = server.call("get_rendering_device");
    if (const std::string driver = server.call("get_current_rendering_driver_name").asString(); driver != "vulkan") {
        why = "the engine draws by " + driver;
        return std::nullopt;
    }
    BrittleVulkan v = brittleDefaultContextDef().vulkan;
    v.instance = handleOf<VkInstance>(device, kTopmostObject);
    v.physical_device = handleOf<VkPhysicalDevice>(device, kPhysicalDevice);
    v.device = handleOf<VkDevice>(device, kLogicalDevice);
    v.queue = handleOf<VkQueue>(device, kCommandQueue);
    v.queue_family = static_cast<uint32_t>(resource(device, kQueueFamily));
    v.api_version = kVulkan11;
    v.features = BRITTLE_FEATURE_SHADER_INT64;
    if (v.instance == nullptr || v.physical_device == nullptr || v.device == nullptr || v.queue == nullptr) {
        why = "the engine does not give its Vulkan device";
        return std::nullopt;
    }
    return v;
}

} // namespace brittle_godot
