// A context of Brittle's and the thread that it is used on; all worlds on one device share it.
#pragma once

#include "modules/brittle/brittle.h"
#include "modules/brittle/godot/device/device_thread.h"
#include "modules/brittle/godot/failure.h"

#include <string>

namespace brittle_godot {

enum class DeviceChoice { Engine = 0, Own = 1 }; // Engine: its own device where it has one that does, else ours

class SharedContext {
public:
    // That of this choice, made where no world has it yet. Throws Failure. On the main thread.
    static std::shared_ptr<SharedContext> open(DeviceChoice choice);
    ~SharedContext();
    SharedContext(const SharedContext&) = delete;
    SharedContext& operator=(const SharedContext&) = delete;

    DeviceThread& thread() { return *thread_; }
    bool isOnEngineDevice() const { return is_engines_; }
    const std::string& deviceName() const { return device_name_; }

    // On the thread, in jobs:
    BrittleContext* context() { return context_; }
    void must(BrittleResult result) const; // throws Failure with the context's last error

private:
    SharedContext(std::unique_ptr<DeviceThread> thread, bool is_engines)
        : thread_(std::move(thread)), is_engines_(is_engines) {}
    static std::shared_ptr<SharedContext> onEngines(); // NULL where there is none, or none to be used, and then with a warning
    void start(const BrittleVulkan& vulkan);
    static void hear(void* user, BrittleLogLevel level, const char* message);

    std::unique_ptr<DeviceThread> thread_;
    BrittleContext* context_ = nullptr;
    bool is_engines_ = false;
    std::string device_name_;
    std::string heard_; // the last error in the log, for what has no context to ask
};

} // namespace brittle_godot
