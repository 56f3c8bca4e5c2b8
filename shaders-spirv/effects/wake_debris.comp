// What touched a fragment that goes has to wake: it may have rested on it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/debris.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, DebrisClock, clocks);
UPDATES(3, BodyState, bodies);

bool leaves(uint body) { return clocks[body].sector.w == DEBRIS_LEAVES; }

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uvec4 ids = memory[p].ids;
    if (ids.z == 0u) return;
    if (leaves(ids.x)) bodies[ids.y].velocity.w = 0.0; // all say the same
    if (leaves(ids.y)) bodies[ids.x].velocity.w = 0.0;
}
