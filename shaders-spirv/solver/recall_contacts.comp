// Which pair of the last step each pair is, and whether its contact still serves: as long as the two bodies have hardly moved
// against each other since its points were found, they are kept, with the arms that they had then, world axes (contact
// recycling, as Box3D does it). Stacks stand by it: points found anew in each step wander, and a tower walks off.
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
layout(push_constant) uniform Push { uint recycling; };
#include "lib/body_way.glsl"

const float kLeastCosine = 0.99240388; // squared, of half the angle: 10 degrees
const float kFurthest = 0.05;          // m
const float kFurthestShare = 0.05;     // of the smaller body

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

bool serves(uint old) {
    uvec4 ids = old_memory[old].ids;
    if (ids.z == 0u) return false;
    vec4 turn_a = bodies[ids.x].turn, turn_b = bodies[ids.y].turn, then_a = old_memory[old].turn_a, then_b = old_memory[old].turn_b;
    float radius_a = shapes[ids.x].inverse_inertia[2].w, radius_b = shapes[ids.y].inverse_inertia[2].w;
    vec3 place = turned(turnBack(turn_a), wayBetween(ids.x, ids.y));
    vec4 apart = turnAfter(turnBack(turnAfter(turnBack(then_a), then_b)), turnAfter(turnBack(turn_a), turn_b));
    float smaller = min(radius_a, radius_b);
    float moved = length(place - old_memory[old].place.xyz) + 2.0 * length(apart.xyz) * max(radius_a, radius_b);
    return min(agreement(turn_a, then_a), agreement(turn_b, then_b)) > kLeastCosine &&
           moved < min(kFurthest, kFurthestShare * smaller);
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uint old = findOld(pairs[p]);
    bool kept = recycling != 0u && old != NO_INDEX && serves(old);
    recalled[p] = old;
    fresh[p] = kept ? 0u : 1u;
}
