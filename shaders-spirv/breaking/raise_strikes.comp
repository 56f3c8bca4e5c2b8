// A body takes part in one blow a step, its hardest: what is struck by hand weighs that against its contacts. A blow of an earlier step
// that waits for room keeps its body awake. It is forgotten if the slot has got another body.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
UPDATES(1, StrikeRecord, records);
UPDATES(2, uint, hardest);
READS(3, BreakableBody, breakable);
UPDATES(4, BodyState, bodies);
#include "lib/origin.glsl"

void main() {
    uint body = flatIndex();
    if (body >= counts[COUNT_BODIES] || records[body].what.x == 0u) return;
    if (records[body].what.z != bornIn(body)) {
        records[body].what.x = 0u;
        return;
    }
    bodies[body].velocity.w = 0.0;
    hardest[body] = max(hardest[body], floatBitsToUint(records[body].blow.z));
    atomicAdd(counts[COUNT_BLOWS], 1u);
}
