// A step, as passes that are recorded once and submitted again and again: recordStep is its diagram.
#include "modules/brittle/dynamics/device_world.h"

#include "modules/brittle/dynamics/step.h"

#include <algorithm>

namespace brittle {

using engine::Error;
using engine::ErrorCode;
using engine::Result;

Result<void> DeviceWorld::makeBreakable(const RoomToBreak& room) {
    auto breaking = Breaking::create(device_, contents_, room, settings_, b_.sizes, budget_.group_size);
    if (!breaking) return breaking.error();
    breaking_ = std::move(*breaking);
    to_break_ = room;
    return {};
}

Result<void> DeviceWorld::record() {
    std::unique_ptr<engine::Commands> recorded[2];
    for (uint32_t parity = 0; parity < 2; parity++) {
        recorded[parity] = std::make_unique<engine::Commands>(device_);
        engine::Commands& commands = *recorded[parity];
        if (auto begun = commands.begin(engine::Commands::Reuse::Many); !begun) return begun;
        if (times_passes_) commands.timeKernels();
        if (auto done = recordInto(commands, parity); !done) return done;
    }
    for (uint32_t parity = 0; parity < 2; parity++) {
        commands_[parity] = std::move(recorded[parity]);
        submitted_[parity] = false;
        if (by_others_[parity]) once_.push_back(std::move(by_others_[parity])); // it may not have run yet
    }
    return {};
}

Result<void> DeviceWorld::step(uint32_t steps) {
    if (auto done = advance(steps); !done) return done;
    return settle();
}

Result<void> DeviceWorld::advance(uint32_t steps) {
    for (uint32_t k = 0; k < steps; ++k, ++ahead_)
        if (auto done = submit(made_ + ahead_); !done) return done;
    return {};
}

Result<void> DeviceWorld::recordSteps(VkCommandBuffer commands, uint32_t steps) {
    for (uint32_t k = 0; k < steps; ++k, ++ahead_) {
        const uint64_t step = made_ + ahead_;
        auto& recording = strikes_.contains(step) ? once_.emplace_back() : by_others_[step & 1];
        if (!recording)
            if (auto recorded = recordForOthers(recording, step); !recorded) return recorded;
        recording->executeIn(commands);
    }
    return {};
}

Result<void> DeviceWorld::strike(const HandBlow& blow) {
    if (auto sound = checkBlow(blow); !sound) return sound;
    if (!breaking_)
        return Error{ErrorCode::BadInput, "nothing in this world can break: it needs the effect impact_fracture, and bodies "
                                          "of a material"};
    if (auto ready = prepareStrikes(); !ready) return ready;
    auto& blows = strikes_[made_ + ahead_].blows;
    if (blows.size() == MOST_STRIKES)
        return Error{ErrorCode::Capacity, "a step takes " + std::to_string(MOST_STRIKES) +
                                              " blows by hand; make a step, or let one blow reach further"};
    blows.push_back(blow);
    return {};
}

Result<void> DeviceWorld::prepareStrikes() {
    if (striking_) return {};
    auto made = breaking_->makeStrikes();
    if (!made) return made.error();
    striking_ = std::move(*made);
    strikes_[made_ + ahead_].is_first = true;
    return record();
}

Result<void> DeviceWorld::kernelsChanged() {
    const auto settled = settle();
    if (auto recorded = record(); !recorded) return recorded;
    if (drawing_)
        if (auto recorded = drawing_->recordAgain(); !recorded) return recorded;
    return settled;
}

Result<void> DeviceWorld::recordInto(engine::Commands& commands, uint32_t parity, const HandBlows* by_hand) {
    Recorder recorder(commands, kernels_, b_.counts, b_.args);
    if (auto recorded = recordStep(recorder, parity, by_hand); !recorded) return recorded;
    return recorder.status();
}

Result<void> DeviceWorld::recordStep(Recorder& record, uint32_t parity, const HandBlows* by_hand) {
    if (by_hand != nullptr && has(Effect::Sleeping)) record.commands().fill(b_.steps.sub(4 * STEPS_ASLEEP, 4), 0);
    const Step step = {settings_, b_,     b_.memory[1 - parity], b_.memory[parity],
                       kernels_,  record, hasManyLanes(device_), has(Effect::Restitution) && bounce()};
    record.clear({b_.counts.sub(0, 4 * STATUS_FAILED)});
    recordBoxes(step);
    if (auto recorded = recordContacts(step); !recorded) return recorded;
    if (by_hand != nullptr) breaking_->recordStrikes(step, *striking_, *by_hand);
    recordIslands(step);
    if (breaking_)
        if (auto recorded = breaking_->recordBlows(step, striking_.get()); !recorded) return recorded;
    recordColors(step);
    if (breaking_) breaking_->recordAdmission(step, striking_.get());
    recordSolve(step);
    recordImpacts(step, breaking_ ? std::optional(breaking_->breakable()) : std::nullopt);
    recordEnd(step);
    if (breaking_) return breaking_->recordEvent(step);
    return {};
}

bool DeviceWorld::bounce() const {
    return std::ranges::any_of(contents_.shapes, [](const auto& shape) { return shape.inverse_inertia[1].w > 0; });
}

Result<void> DeviceWorld::submit(uint64_t step) {
    const uint32_t parity = step & 1;
    if (const auto blows = strikes_.find(step); blows != strikes_.end()) return submitOnce(parity, blows->second);
    constexpr std::chrono::milliseconds kPatience(700); // in which a driver has read from its cache what a step takes
    const bool is_first = !submitted_[0] && !submitted_[1];
    if (is_first) warmup_.emplace(device_, kernels_, kPatience);
    engine::Commands& commands = *commands_[parity];
    if (auto submitted = submitted_[parity] ? commands.submitAgain() : commands.submit(); !submitted) return submitted;
    submitted_[parity] = true;
    auto waited = commands.wait();
    if (is_first) warmup_->stop();
    return waited;
}

Result<void> DeviceWorld::submitOnce(uint32_t parity, const HandBlows& by_hand) {
    engine::Commands commands(device_);
    if (auto begun = commands.begin(); !begun) return begun;
    if (auto recorded = recordInto(commands, parity, &by_hand); !recorded) return recorded;
    return commands.submitAndWait();
}

Result<void> DeviceWorld::recordForOthers(std::unique_ptr<engine::Commands>& recording, uint64_t step) {
    auto commands = std::make_unique<engine::Commands>(device_);
    if (auto begun = commands->begin(engine::Commands::Reuse::ByOthers); !begun) return begun;
    const auto blows = strikes_.find(step);
    const auto* by_hand = blows != strikes_.end() ? &blows->second : nullptr;
    if (auto recorded = recordInto(*commands, step & 1, by_hand); !recorded) return recorded;
    if (auto ended = commands->end(); !ended) return ended;
    recording = std::move(commands);
    return {};
}

} // namespace brittle
