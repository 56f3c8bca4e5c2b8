#include "modules/brittle/godot/device/session.h"

#include "modules/brittle/godot/device/engine_device.h"
#include "modules/brittle/godot/interface/messages.h"
#include "modules/brittle/godot/interface/value.h"

#include <array>

namespace brittle_godot {
namespace {

std::array<std::weak_ptr<Session>, 2> open_sessions; // of the main thread's

} // namespace

std::shared_ptr<Session> Session::open(DeviceChoice choice) {
    std::weak_ptr<Session>& kept = open_sessions.at(static_cast<size_t>(choice));
    if (auto session = kept.lock()) return session;
    std::shared_ptr<Session> session = choice == DeviceChoice::Engine ? onEngines() : nullptr;
    if (session == nullptr) {
        session.reset(new Session(callingThread(), false));
        session->start(brittleDefaultContextDef().vulkan);
    }
    kept = session;
    return session;
}

std::shared_ptr<Session> Session::onEngines() {
    if (singleton("RenderingServer").call("get_rendering_device").isNull()) return nullptr; // as headless
    std::shared_ptr<Session> session(new Session(renderThread(), true));
    std::string why;
    std::optional<BrittleVulkan> vulkan;
    try {
        session->thread().run([&] { vulkan = engineVulkan(why); });
        if (vulkan) {
            session->start(*vulkan);
            return session;
        }
    } catch (const Failure& failure) {
        why = failure.what();
    }
    tellWarning("Brittle works on a Vulkan device of its own, since " + why);
    return nullptr;
}

void Session::start(const BrittleVulkan& vulkan) {
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

Session::~Session() {
    thread_->run([&] { brittleDestroyContext(context_); });
}

void Session::must(BrittleResult result) const {
    if (result != BRITTLE_OK) throw Failure(brittleLastError(context_));
}

void Session::hear(void* user, BrittleLogLevel level, const char* message) {
    if (level == BRITTLE_LOG_ERROR) static_cast<Session*>(user)->heard_ = message;
    if (level == BRITTLE_LOG_WARNING) tellWarning(message);
}

} // namespace brittle_godot
