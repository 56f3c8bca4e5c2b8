// Of two bodies, one of them of several pieces, each piece is judged on its own, as if it were all that there is: what comes at one of
// them within the step would go on through it and meet those behind, on faces that lie inside. Only what meets first breaks something,
// and what meets together with it. Besides, when the first blow of each body comes.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs); // of pieces, in order
READS(2, ContactMemory, memory);
READS(3, BodyState, bodies);
READS(4, BodyShape, shapes);
READS(5, BreakableBody, breakable);
UPDATES(6, BlowRecord, blows);
UPDATES(7, uint, soonest); // in steps, as bits: of floats that are not negative the order is the same
layout(push_constant) uniform Push { float duration; }; // of the step, s
#include "lib/blow_place.glsl"
#include "lib/takes_part.glsl"
#define SORTED_KEY(i) pairs[i].x
#define SORTED_COUNT COUNT_STRUCK
#include "lib/sorted_list.glsl"

float meetsAt(uint p) { return uintBitsToFloat(blows[p].sides.y); }

// What touches already and hardly comes closer, such as a foot to turn over on, stops nothing.
bool stops(uint p, float speed) {
    float own = blows[p].blow.y;
    return own >= kSlower * speed || meetsAt(p) * duration * own > kTogether;
}

bool isStoppedBefore(uint p) {
    uvec2 ids = memory[p].ids.xy, of = shapes[ids.x].pieces.xy;
    if (of.y + shapes[ids.y].pieces.y <= 2u) return false;
    float speed = blows[p].blow.y, before = meetsAt(p) - kTogether / (duration * speed);
    for (uint other = firstFrom(of.x), end = firstFrom(of.x + of.y); other < end; other++)
        if (memory[other].ids.y == ids.y && meetsAt(other) < before && stops(other, speed)) return true;
    return false;
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_STRUCK] || blows[p].sides.x == 0u) return;
    if (isStoppedBefore(p)) {
        blows[p].sides.x = 0u;
        return;
    }
    uvec2 ids = memory[p].ids.xy;
    uint time = blows[p].sides.y;
    if (takesPart(ids.x)) atomicMin(soonest[ids.x], time);
    if (takesPart(ids.y)) atomicMin(soonest[ids.y], time);
}
