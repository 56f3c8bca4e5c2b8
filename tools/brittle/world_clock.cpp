#include "tools/brittle/world_clock.h"

#include "modules/brittle/dynamics/sector_place.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tools/brittle/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace cli {
namespace {

using brittle::operator+;
using engine::Result;

constexpr double kOnMoment = 1e-6; // of a step: so near to one a moment is on it

// So much later, as they fly.
std::vector<Speck> specksOf(const std::vector<gpu::DustParticle>& dust, double later) {
    std::vector<Speck> specks;
    for (const gpu::DustParticle& p : dust) {
        const brittle::Double3 way = {later * p.velocity.x, later * p.velocity.y, later * p.velocity.z};
        specks.push_back({brittle::placeOf(p.sector, p.place) + way, double{p.place.w}, p.birth.y});
    }
    return specks;
}

template <class Event>
void append(const brittle::HeardEvents<Event>& heard, brittle::HeardEvents<Event>& all) {
    all.events.insert(all.events.end(), heard.events.begin(), heard.events.end());
    all.lost += heard.lost;
}

} // namespace

Result<Moment> WorldClock::momentAt(double time) {
    const double steps = time / dt_;
    const auto before = static_cast<uint64_t>(std::floor(steps + kOnMoment));
    const double share = steps - static_cast<double>(before);
    const auto first = keptOf(before);
    if (!first) return first.error();
    if (share < kOnMoment || before == last_step_) return Moment{(*first)->poses, specksOf((*first)->dust, 0)};
    const auto second = keptOf(before + 1);
    if (!second) return second.error();
    return Moment{brittle::between((*first)->poses, (*second)->poses, share), specksOf((*first)->dust, share * dt_)};
}

Result<const WorldClock::Kept*> WorldClock::keptOf(uint64_t step) {
    if (const auto found = kept_.find(step); found != kept_.end()) return &found->second;
    if (auto advanced = advanceTo(step); !advanced) return advanced.error();
    auto poses = cast_.poses();
    if (!poses) return poses.error();
    auto dust = world_.dust();
    if (!dust) return dust.error();
    if (kept_.size() > 1) kept_.erase(kept_.begin());
    return &(kept_[step] = {std::move(*poses), std::move(dust->flying)});
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
    if (auto heard = hearEvents(); !heard) return heard;
    const auto timings = world_.timings();
    if (!timings) return timings.error();
    for (const engine::Timing& timing : *timings)
        addStage(timing);
    return {};
}

Result<void> WorldClock::hearEvents() {
    const auto breaks = world_.breaks();
    if (!breaks) return breaks.error();
    append(*breaks, breaks_);
    const auto impacts = world_.impacts();
    if (!impacts) return impacts.error();
    append(*impacts, impacts_);
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
