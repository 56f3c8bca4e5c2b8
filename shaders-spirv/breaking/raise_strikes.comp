// A body takes part in one blow a step, its hardest: what is struck by hand weighs that against its contacts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, StrikeRecord, records);
UPDATES(2, uint, hardest);

void main() {
    uint body = flatIndex();
    if (body >= counts[COUNT_BODIES] || records[body].what.x == 0u) return;
    hardest[body] = max(hardest[body], floatBitsToUint(records[body].blow.z));
    atomicAdd(counts[COUNT_BLOWS], 1u);
}
