// Bodies that touch, or may before the step is over, are of one island; what does not move joins none.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
UPDATES(3, uint, parents);
#include "lib/union_find.glsl"

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uvec4 ids = memory[p].ids;
    if (ids.z == 0u || bodies[ids.x].offset.w == 0.0 || bodies[ids.y].offset.w == 0.0) return;
    if (!unite(ids.x, ids.y)) atomicOr(counts[STATUS_FAILED], FAILED_ISLANDS);
}
