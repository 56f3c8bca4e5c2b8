// What touched a body that is broken by hand has to wake: it may have rested on it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"
#include "shared/strike.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, StrikeRecord, records);
UPDATES(3, BodyState, bodies);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uvec4 ids = memory[p].ids;
    if (ids.z == 0u) return;
    if (records[ids.x].what.x != 0u) bodies[ids.y].velocity.w = 0.0; // all say the same
    if (records[ids.y].what.x != 0u) bodies[ids.x].velocity.w = 0.0;
}
