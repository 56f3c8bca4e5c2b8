#include "modules/brittle/godot/device/device_thread.h"

#include "modules/brittle/godot/interface/value.h"

#include <future>

namespace brittle_godot {
namespace {

class CallingThread final : public DeviceThread {
    void post(std::function<void()> job) override { job(); }
};

// Where the engine draws on its main thread, it calls the job at once; else the job waits its turn among drawing commands.
class RenderThread final : public DeviceThread {
    void post(std::function<void()> job) override {
        singleton("RenderingServer").call("call_on_render_thread", {Value::callable(std::move(job))});
    }
};

} // namespace

void DeviceThread::run(const std::function<void()>& job) {
    std::promise<void> done;
    post([&] {
        try {
            job();
            done.set_value();
        } catch (...) {
            done.set_exception(std::current_exception());
        }
    });
    done.get_future().get();
}

std::unique_ptr<DeviceThread> callingThread() { return std::make_unique<CallingThread>(); }
std::unique_ptr<DeviceThread> renderThread() { return std::make_unique<RenderThread>(); }

} // namespace brittle_godot
