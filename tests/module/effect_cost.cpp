#include "tests/module/effect_cost.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numeric>

namespace effect_cost {

Cost costOf(brittle::World& world, uint32_t steps) {
    const auto us = world.measure(steps);
    const auto plan = world.plan();
    EXPECT_TRUE(us && plan);
    return {plan->bytes(), std::accumulate(us->begin(), us->end(), 0.0)};
}

void tell(brittle::Effect effect, const Cost& on, const Cost& off) {
    std::printf("%-16s on: %10llu bytes, %8.1f us; off: %10llu bytes, %8.1f us\n", nameOf(effect).data(),
                static_cast<unsigned long long>(on.bytes), on.us, static_cast<unsigned long long>(off.bytes), off.us);
}

} // namespace effect_cost
