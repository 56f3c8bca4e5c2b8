// The frame: a fixed step, every module in order, one submission.
#pragma once

#include "engine/module.h"

namespace engine {

struct FrameReport {
    uint64_t index = 0;
    double time = 0; // at its end, seconds
    std::vector<Timing> timings;
};

class FrameLoop {
public:
    // `modules` has been started on this device and outlives the loop; `dt` in seconds.
    FrameLoop(Device& device, ModuleRegistry& modules, double dt)
        : device_(device), modules_(modules), commands_(device), dt_(dt) {}

    // Records, submits and waits. After an error time has not moved on.
    Result<FrameReport> step();
    uint64_t index() const { return index_; }
    double time() const { return static_cast<double>(index_) * dt_; }

private:
    Device& device_;
    ModuleRegistry& modules_;
    Commands commands_;
    double dt_;
    uint64_t index_ = 0;
};

} // namespace engine
