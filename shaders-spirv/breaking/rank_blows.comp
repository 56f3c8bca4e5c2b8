// The energy of each body's hardest blow, of those that come first, or together with the first, to both.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
READS(3, BreakableBody, breakable);
READS(4, uint, soonest);
UPDATES(5, BlowRecord, blows);
UPDATES(6, uint, hardest); // as bits: of floats that are not negative the order is the same
layout(push_constant) uniform Push { float duration; }; // of the step, s
#include "lib/blow_place.glsl"
#include "lib/takes_part.glsl"

bool comesFirst(uint body, BlowRecord b) {
    float after = uintBitsToFloat(b.sides.y) - uintBitsToFloat(soonest[body]);
    return !takesPart(body) || after * duration * b.blow.y <= kTogether;
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_STRUCK] || blows[p].sides.x == 0u) return;
    uvec2 ids = memory[p].ids.xy;
    BlowRecord b = blows[p];
    if (!comesFirst(ids.x, b) || !comesFirst(ids.y, b)) return;
    blows[p].sides.z = 1u;
    if (takesPart(ids.x)) atomicMax(hardest[ids.x], floatBitsToUint(b.blow.z));
    if (takesPart(ids.y)) atomicMax(hardest[ids.y], floatBitsToUint(b.blow.z));
}
