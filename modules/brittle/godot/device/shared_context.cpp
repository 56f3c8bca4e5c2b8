#include "modules/brittle/godot/device/shared_context.h"

#include "modules/brittle/godot/device/engine_device.h"
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/interface/value.h"

#include <array>

namespace brittle_godot {
namespace {

std::array<std::weak_ptr<SharedContext>, 2> open_contexts; // of the main thread's

} // namespace

std::shared_ptr<SharedContext> SharedContext::open(DeviceChoice choice) {
    std::weak_ptr<SharedContext>& kept = open_contexts.at(static_cast<size_t>(choice));
    if (auto shared = kept.lock()) return shared;
    std::shared_ptr<SharedContext> shared = choice == DeviceChoice::Engine ? onEngines() : nullptr;
    if (shared == nullptr) {
        shared.reset(new SharedContext(callingThread(), false));
        shared->start(brittleDefaultContextDef().vulkan);
    }
    kept = shared;
    return shared;
}

std::shared_ptr<SharedContext> SharedContext::onEngines() {
    if (singleton("RenderingServer").call("get_rendering_device").isNull()) return nullptr; // as headless
    std::shared_ptr<SharedContext> shared(new SharedContext(renderThread(), true));
    std::string why;
    std::optional<BrittleVulkan> vulkan;
    try {
        shared->thread().run([&] { vulkan = engineVulkan(why); });
        if (vulkan) {
            shared->start(*vulkan);
            return shared;
        }
    } catch (const Failure& failure) {
        why = failure.what();
    }
    tellWarning("Brittle works on a Vulkan device of its own, since " + why);
    return nullptr;
}

void SharedContext::start(const BrittleVulkan& vulkan) {
    thread_->run([&] {
        BrittleContextDef def = brittleDefaultContextDef();
        def.vulkan = vulkan;
        def.log = hear;
        def.log_user = this;
        if (brittleCreateContext(&def, &context_) != BRITTLE_OK) throw Failure(heard_);
        BrittleVulkan made = def.vulkan;
        must(brittleGetVulkan(context_, &made));
        device_name_ = made.device_name;
    });
}

SharedContext::~SharedContext() {
    thread_->run([&] { brittleDestroyContext(context_); });
}

void SharedContext::must(BrittleResult result) const {
    if (result != BRITTLE_OK) throw Failure(brittleLastError(context_));
}

void SharedContext::hear(void* user, BrittleLogLevel level, const char* message) {
    if (level == BRITTLE_LOG_ERROR) static_cast<SharedContext*>(user)->heard_ = message;
    if (level == BRITTLE_LOG_WARNING) tellWarning(message);
}

} // namespace brittle_godot
