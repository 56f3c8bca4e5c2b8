// Where all that touches the device runs, one job after the other: on the engine's render thread, which alone may use the
// engine's queue, or, for a device of our own, on the thread that asks.
#pragma once

#include <functional>
#include <memory>

namespace brittle_godot {

class DeviceThread {
public:
    virtual ~DeviceThread() = default;
    // Runs after all that was posted before; may return before that. The job must not throw.
    virtual void post(std::function<void()> job) = 0;
    // The same, and waits; what the job throws comes out here. Not to be called on that thread by a job.
    void run(const std::function<void()>& job);
};

std::unique_ptr<DeviceThread> callingThread();
std::unique_ptr<DeviceThread> renderThread();

} // namespace brittle_godot
