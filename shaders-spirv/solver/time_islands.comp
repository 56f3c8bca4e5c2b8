// How long each island has been at rest: as long as that body of it which moved last.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BodyState, bodies);
READS(2, uint, islands);
UPDATES(3, uint, rests); // of an island, by its name: s, as bits; the largest float to begin with

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || bodies[b].offset.w == 0.0) return;
    atomicMin(rests[islands[b]], floatBitsToUint(bodies[b].velocity.w));
}
