// Worlds that break more than there is room for: every pool full to the brim.
#pragma once

#include "modules/brittle/breaking/room_to_break.h"
#include "tests/hard/hard_case.h"

namespace hard {

struct PoolCase {
    const char* name;
    void (*shrink)(brittle::BreakingBudget& budget);
    uint32_t why = 0;               // WHOLE_*, that the event says
    std::array<bool, 4> lacks = {}; // of bodies, pieces, faces and triangles
};

std::span<const PoolCase> poolCases();
void measurePool(Trial& trial, const PoolCase& self);

} // namespace hard
