// Contacts of islands that sleep are remembered but not solved.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
READS(3, uint, islands);
READS(4, uint, rests);
UPDATES(5, uint, touches);
layout(push_constant) uniform Push { float sleep_after; }; // s

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS] || touches[p] == 0u) return;
    uvec4 ids = memory[p].ids;
    uint mover = bodies[ids.x].offset.w != 0.0 ? ids.x : ids.y;
    if (uintBitsToFloat(rests[islands[mover]]) >= sleep_after) touches[p] = 0u;
}
