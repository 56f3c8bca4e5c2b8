#include "engine/hazards.h"

#include <algorithm>

namespace engine {

std::optional<BarrierSource> HazardTracker::add(std::span<const Access> accesses) {
    std::optional<BarrierSource> barrier;
    if (std::ranges::any_of(accesses, [this](const Access& a) { return conflicts(a); })) barrier = flush();
    past_.insert(past_.end(), accesses.begin(), accesses.end());
    return barrier;
}

BarrierSource HazardTracker::flush() {
    BarrierSource source;
    for (const Access& a : past_) {
        source.stages |= a.stage;
        if (a.write) source.writes |= a.mask;
    }
    past_.clear();
    return source;
}

bool HazardTracker::conflicts(const Access& access) const {
    return std::ranges::any_of(past_, [&](const Access& p) {
        return (p.write || access.write) && p.buffer == access.buffer && p.begin < access.end && access.begin < p.end;
    });
}

} // namespace engine
