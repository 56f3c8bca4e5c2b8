// Which island each body is of, and how long an island has been at rest: as long as that body of it which moved last.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BodyState, bodies);
UPDATES(2, uint, parents);
WRITES(3, uint, islands);
UPDATES(4, uint, rests);
#include "lib/union_find.glsl"

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES]) return;
    uint root = rootOf(b);
    islands[b] = root;
    if (bodies[b].offset.w != 0.0) atomicMin(rests[root], floatBitsToUint(bodies[b].velocity.w));
}
