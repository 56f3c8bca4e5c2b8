#include "tools/brittle/world_clock.h"

#include "tools/brittle/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cli {
namespace {

using engine::Result;

constexpr double kOnStep = 1e-6; // of a step: so near to one a moment is on it

} // namespace

Result<brittle::Poses> WorldClock::posesAt(double time) {
    const double steps = time / dt_;
    const auto before = static_cast<uint64_t>(std::floor(steps + kOnStep));
    const double share = steps - static_cast<double>(before);
    const auto first = posesOf(before);
    if (!first) return first.error();
    if (share < kOnStep || before == last_step_) return **first;
    const auto second = posesOf(before + 1);
    if (!second) return second.error();
    return brittle::between(**first, **second, share);
}

Result<const brittle::Poses*> WorldClock::posesOf(uint64_t step) {
    if (const auto found = kept_.find(step); found != kept_.end()) return &found->second;
    if (auto advanced = advanceTo(step); !advanced) return advanced.error();
    auto poses = cast_.poses();
    if (!poses) return poses.error();
    if (kept_.size() > 1) kept_.erase(kept_.begin());
    return &(kept_[step] = std::move(*poses));
}

Result<void> WorldClock::advanceTo(uint64_t step) {
    while (made_ < step) {
        showProgress("step " + std::to_string(made_ + 1) + " of " + std::to_string(last_step_));
        if (auto done = stepOnce(); !done) return done;
    }
    return {};
}

Result<void> WorldClock::stepOnce() {
    const auto start = std::chrono::steady_clock::now();
    if (auto done = world_.step(); !done) return done;
    ms_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    ++made_;
    if (auto heard = hearBreaks(); !heard) return heard;
    const auto timings = world_.timings();
    if (!timings) return timings.error();
    for (const engine::Timing& timing : *timings)
        addStage(timing);
    return {};
}

Result<void> WorldClock::hearBreaks() {
    const auto heard = world_.breaks();
    if (!heard) return heard.error();
    breaks_.events.insert(breaks_.events.end(), heard->events.begin(), heard->events.end());
    breaks_.lost += heard->lost;
    return {};
}

void WorldClock::addStage(const engine::Timing& timing) {
    const auto found = std::ranges::find(stages_, timing.name, &std::pair<std::string, double>::first);
    if (found == stages_.end())
        stages_.emplace_back(timing.name, timing.ms);
    else
        found->second += timing.ms;
}

} // namespace cli
