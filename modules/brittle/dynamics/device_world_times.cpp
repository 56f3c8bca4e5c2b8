// What a world would do, and how long it takes.
#include "modules/brittle/dynamics/device_world.h"

#include "modules/brittle/dynamics/step.h"

#include <algorithm>

namespace brittle {

using engine::Result;

Result<std::vector<engine::Timing>> DeviceWorld::timings() {
    if (auto settled = settle(); !settled) return settled.error();
    return commands_[(made_ + 1) & 1]->timings();
}

Result<StepPlan> DeviceWorld::plan() {
    engine::Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun.error();
    commands.keepTrace();
    Recorder recorder(commands, kernels_, b_.counts, b_.args);
    if (auto recorded = recordStep(recorder, 0); !recorded) return recorded.error();
    if (auto recorded = recorder.status(); !recorded) return recorded.error();
    return planOf(commands.trace(), memory(), kernels_.kernelNames());
}

Result<std::vector<double>> DeviceWorld::measure(uint32_t steps) {
    const bool before = std::exchange(times_passes_, true);
    auto recorded = record();
    auto medians = recorded ? mediansOf(steps) : Result<std::vector<double>>(recorded.error());
    times_passes_ = before;
    if (recorded = record(); !recorded) return recorded.error();
    return medians;
}

Result<void> DeviceWorld::timeKernels(bool on) {
    if (auto settled = settle(); !settled) return settled;
    times_passes_ = on;
    return record();
}

Result<std::vector<double>> DeviceWorld::mediansOf(uint32_t steps) {
    std::vector<std::vector<double>> times; // of each dispatch
    for (uint32_t k = 0; k < std::max(steps, 1u); k++) {
        if (auto done = step(1); !done) return done.error();
        const auto spans = commands_[(made_ + 1) & 1]->spanTimes();
        if (!spans) return spans.error();
        times.resize(spans->size()); // of a queue without timestamps there are none
        for (size_t pass = 0; pass < times.size(); pass++)
            times[pass].push_back(1000 * (*spans)[pass]);
    }
    std::vector<double> medians;
    for (std::vector<double>& of_pass : times) {
        const auto middle = of_pass.begin() + static_cast<ptrdiff_t>(of_pass.size() / 2);
        std::ranges::nth_element(of_pass, middle);
        medians.push_back(*middle);
    }
    return medians;
}

namespace {

// Names the passes for a probe.
class NamedCommands final : public engine::CommandProbe {
public:
    NamedCommands(PassProbe& probe, PlannedMemory memory) : probe_(probe), memory_(std::move(memory)) {}
    Result<void> before(const engine::TracedCommand& command) override {
        pass_ = passOf(command, memory_);
        return probe_.before(pass_, command);
    }
    Result<void> after(const engine::TracedCommand& command) override { return probe_.after(pass_, command); }

private:
    PassProbe& probe_;
    PlannedMemory memory_;
    Pass pass_;
};

} // namespace

Result<void> DeviceWorld::probeStep(PassProbe& probe) {
    if (auto settled = settle(); !settled) return settled;
    if (strikes_.contains(made_))
        return engine::Error{engine::ErrorCode::BadInput, "a step with a blow by hand cannot be probed; make it with step()"};
    engine::Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun;
    for (const engine::BufferView& view : stepMemory())
        commands.fill(view, 0);
    NamedCommands named(probe, memory());
    commands.showTo(named);
    if (auto recorded = recordInto(commands, made_ & 1); !recorded) return recorded;
    if (auto ran = commands.submitAndWait(); !ran) return ran;
    ++ahead_;
    return settle();
}

std::vector<engine::BufferView> DeviceWorld::stepMemory() const {
    std::vector<engine::BufferView> views = {b_.counts, b_.args, b_.arena->buffer()};
    if (breaking_) std::ranges::copy(breaking_->stepMemory(), std::back_inserter(views));
    return views;
}

PlannedMemory DeviceWorld::memory() const {
    PlannedMemory memory = {b_.sizes.effects, b_.named, b_.args, {}};
    if (!breaking_) return memory;
    std::ranges::copy(breaking_->buffers(), std::back_inserter(memory.named));
    memory.fracture_args = breaking_->arguments();
    return memory;
}

} // namespace brittle
