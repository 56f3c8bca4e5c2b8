// What an effect costs, which tests of gates tell and do not judge.
#pragma once

#include "modules/brittle/dynamics/world.h"

namespace effect_cost {

struct Cost {
    uint64_t bytes = 0; // on the device
    double us = 0;      // of all passes of a step: the sum of their medians
};
Cost costOf(brittle::World& world, uint32_t steps);
void tell(brittle::Effect effect, const Cost& on, const Cost& off);

} // namespace effect_cost
