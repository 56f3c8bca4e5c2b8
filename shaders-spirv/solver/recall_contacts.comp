// Which pair of the last step each pair is, and whether its contact still serves: as long as the two bodies have hardly moved
// against each other since its points were found, they are kept, with the arms that they had then, world axes (contact
// recycling, as Box3D does it). Stacks stand by it: points found anew in each step wander, and a tower walks off. Between two
// bodies that have slept nothing has changed at all.
//
// Pairs that do not touch, most of those whose boxes meet, are not looked at again before they can have come near: the gap that was
// found, less what they have moved against each other since and may move in this step, is more than what points are looked for in.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/broad_phase.h"
#include "shared/solver.h"
#include "shared/body.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, uint, old_counts); // one word: how many pairs there were
READS(3, uvec2, old_pairs);
READS(4, ContactMemory, old_memory);
READS(5, BodyState, bodies);
READS(6, BodyShape, shapes);
WRITES(7, uint, recalled); // where the pair was, or NO_INDEX
WRITES(8, uint, fresh);    // 1 where points are to be found
layout(push_constant) uniform Push {
    vec4 gravity; // w: for how long pairs are swept, s
    float speculative;
    uint recycling;
};
#include "lib/body_way.glsl"
#include "lib/rim_speed.glsl"

const float kLeastCosine = 0.99240388; // squared, of half the angle: 10 degrees
const float kFurthest = 0.05;          // m
const float kFurthestShare = 0.03;     // of the smaller body
const float kLessRounding = 0.9999;

bool before(uvec2 a, uvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

uint findOld(uvec2 pair) {
    uint low = 0u, high = old_counts[0];
    for (uint step = 0u; step < 32u && low < high; step++) {
        uint middle = (low + high) / 2u;
        if (before(old_pairs[middle], pair)) low = middle + 1u;
        else high = middle;
    }
    uint at = min(low, max(old_counts[0], 1u) - 1u);
    return low < old_counts[0] && old_pairs[at] == pair ? at : NO_INDEX;
}

float agreement(vec4 p, vec4 q) {
    float cosine = dot(p, q);
    return cosine * cosine;
}

float radiusOf(uint body) { return shapes[body].inverse_inertia[2].w; }

// How far any point of the smaller body has moved, as the larger one sees it, at most, since the pair was looked at. The other way
// around a cube that turns a little would seem to move the far end of the ground by meters.
float movedSince(uint old, uint a, uint b) {
    vec4 then_a = old_memory[old].turn_a, then_b = old_memory[old].turn_b, turn_a = bodies[a].turn, turn_b = bodies[b].turn;
    bool of_a = radiusOf(a) >= radiusOf(b);
    vec3 way = wayBetween(a, b), place = old_memory[old].place.xyz;
    vec3 then = of_a ? place : turned(turnBack(then_b), turned(then_a, place));
    vec4 apart = turnAfter(turnBack(turnAfter(turnBack(then_a), then_b)), turnAfter(turnBack(turn_a), turn_b));
    return length(turned(turnBack(of_a ? turn_a : turn_b), way) - then) + 2.0 * length(apart.xyz) * min(radiusOf(a), radiusOf(b));
}

bool serves(uint old, uint a, uint b) {
    float least = min(agreement(bodies[a].turn, old_memory[old].turn_a), agreement(bodies[b].turn, old_memory[old].turn_b));
    return least > kLeastCosine && movedSince(old, a, b) < min(kFurthest, kFurthestShare * min(radiusOf(a), radiusOf(b)));
}

float movesBy(uint body) { return bodies[body].offset.w == 0.0 ? 0.0 : 1.0; }

bool staysApart(uint old, uint a, uint b) {
    vec3 falling = gravity.w * gravity.xyz * (movesBy(b) - movesBy(a));
    float way = gravity.w * length(bodies[b].velocity.xyz - bodies[a].velocity.xyz + falling);
    float turning = gravity.w * (rimSpeed(a) + rimSpeed(b));
    return old_memory[old].place.w * kLessRounding > movedSince(old, a, b) + way + turning + speculative;
}

bool isStill(uint body) { return bodies[body].offset.w == 0.0 || (bodies[body].sector.w & BODY_ASLEEP) != 0; }

// Whether what is known of the pair still holds.
bool holds(uint old) {
    uvec4 ids = old_memory[old].ids;
    if (isStill(ids.x) && isStill(ids.y)) return true;
    return ids.z == 0u ? staysApart(old, ids.x, ids.y) : recycling != 0u && serves(old, ids.x, ids.y);
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uint old = findOld(pairs[p]);
    recalled[p] = old;
    fresh[p] = old != NO_INDEX && holds(old) ? 0u : 1u;
}
