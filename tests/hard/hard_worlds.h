// Worlds that break more than there is room for: every pool full to the brim.
#pragma once

#include "modules/brittle/dynamics/world.h"
#include "tests/hard/hard_case.h"

namespace hard {

struct PoolCase {
    const char* name;
    void (*shrink)(brittle::WorldBudget& budget);
    uint32_t why = 0; // WHOLE_*, that the event says
    std::array<bool, 4> lacks =
        {}; // of bodies, pieces, faces and triangles; of WHOLE_NO_PAIRS pairs and contacts, of WHOLE_TOO_LARGE triangles
};

std::span<const PoolCase> poolCases();
void measurePool(Trial& trial, const PoolCase& self);

} // namespace hard
