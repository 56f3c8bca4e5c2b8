// After contacts have chosen: a body whose hardest blow is one by hand is broken by that.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, StrikeRecord, records);
READS(2, uint, hardest);
WRITES(3, uint, chosen);

void main() {
    uint body = flatIndex();
    if (body >= counts[COUNT_BODIES] || records[body].what.x == 0u) return;
    if (hardest[body] == floatBitsToUint(records[body].blow.z)) chosen[body] = uint(STRUCK_BY_HAND) | body;
}
