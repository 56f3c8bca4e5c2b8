// The memory of this step: what still serves is taken over as it is; new points take the impulses of old ones that are the same
// features.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "lib/effect.glsl"
#include "shared/broad_phase.h"
#include "shared/solver.h"
#include "shared/body.h"

FLAT_KERNEL;
FRICTION_EFFECT;
READS(0, uint, counts);
READS(1, uint, recalled);
READS(2, uint, fresh_slots); // prefix sum of `fresh`: where a fresh pair's manifold lies
READS(3, Manifold, manifolds);
READS(4, ContactMemory, old_memory);
READS(5, BodyState, bodies);
READS(6, BodyShape, shapes);
WRITES(7, ContactMemory, memory);
WRITES(8, uint, touches); // 1 where there are points
#include "lib/body_way.glsl"

const float kFar = 3e38;

vec3 anyTangent(vec3 normal) {
    if (normal == vec3(0.0)) return normal; // of a pair that does not touch
    vec3 axis = abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(normal, axis));
}

// What the point that was the same features was pressed with, and what it had carried.
vec2 impulsesOf(uint old, uint feature) {
    vec2 found = vec2(0.0);
    uint points = old == NO_INDEX ? 0u : old_memory[old].ids.z;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) {
        bool same = floatBitsToUint(old_memory[old].anchor_b[k].w) == feature;
        found = same ? vec2(old_memory[old].anchor_a[k].w, old_memory[old].arm_b[k].w) : found;
    }
    return found;
}

// Friction holds in a plane, so what it was in the old one is turned into the new.
vec3 rubOf(uint old, vec3 normal, vec3 tangent) {
    vec3 was = old_memory[old].normal.xyz, along = old_memory[old].tangent.xyz, rub = old_memory[old].rub.xyz;
    vec3 slide = rub.x * along + rub.y * cross(was, along);
    return vec3(dot(slide, tangent), dot(slide, cross(normal, tangent)), rub.z);
}

// The smaller body is pushed where it was touched, or what slides along a wide one would be turned by an arm as long as its way.
float armsOf(uint a, uint b) {
    bool a_is_smaller = shapes[a].inverse_inertia[2].w < shapes[b].inverse_inertia[2].w;
    return float(a_is_smaller ? ARMS_OF_B_FOLLOW : ARMS_OF_A_FOLLOW);
}

// Members are read where they are needed, and copied one by one: a struct with arrays that is looked at as a whole is unrolled by
// compilers, and takes a software device half a second to compile.
void remember(uint p, uint slot, uint old) {
    uvec4 ids = manifolds[slot].pair;
    vec4 normal = manifolds[slot].normal;
    uint a = ids.z, b = ids.w, points = manifolds[slot].info.x;
    // A pair that does not touch gives its color back: others may take it by the time they touch again.
    uint color = old == NO_INDEX || points == 0u ? NO_INDEX : old_memory[old].ids.w;
    vec4 turn_a = bodies[a].turn, turn_b = bodies[b].turn;
    vec3 tangent = anyTangent(normal.xyz);
    vec4 surface_a = vec4(shapes[a].inverse_inertia[0].w, shapes[a].inverse_inertia[1].w, 0.0, 0.0);
    vec4 surface_b = vec4(shapes[b].inverse_inertia[0].w, shapes[b].inverse_inertia[1].w, 0.0, 0.0);
    memory[p].ids = uvec4(a, b, min(points, MANIFOLD_POINTS), color);
    memory[p].normal = vec4(normal.xyz, sqrt(surface_a.x * surface_b.x));
    memory[p].tangent = vec4(tangent, max(surface_a.y, surface_b.y));
    memory[p].rub.w = armsOf(a, b);
    if (kFriction != 0u) memory[p].rub.xyz = old == NO_INDEX ? vec3(0.0) : rubOf(old, normal.xyz, tangent);
    memory[p].pace = old == NO_INDEX || points == 0u ? uvec4(0u) : old_memory[old].pace;
    memory[p].turn_a = turn_a;
    memory[p].turn_b = turn_b;
    memory[p].place = vec4(turned(turnBack(turn_a), wayBetween(a, b)), points == 0u ? normal.w : 0.0);
    for (uint k = 0u; k < MANIFOLD_POINTS && k < points; k++) {
        uint feature = manifolds[slot].points[k].id.x;
        vec4 arm_a = manifolds[slot].points[k].arm_a, arm_b = manifolds[slot].points[k].arm_b;
        vec2 impulses = impulsesOf(old, feature);
        memory[p].anchor_a[k] = vec4(turned(turnBack(turn_a), arm_a.xyz), impulses.x);
        memory[p].anchor_b[k] = vec4(turned(turnBack(turn_b), arm_b.xyz), uintBitsToFloat(feature));
        memory[p].arm_a[k] = arm_a;
        memory[p].arm_b[k] = vec4(arm_b.xyz, impulses.y);
    }
}

void takeOver(uint p, uint old) {
    memory[p].ids = old_memory[old].ids;
    memory[p].normal = old_memory[old].normal;
    memory[p].tangent = old_memory[old].tangent;
    memory[p].rub.w = old_memory[old].rub.w;
    if (kFriction != 0u) memory[p].rub.xyz = old_memory[old].rub.xyz;
    memory[p].pace = old_memory[old].pace;
    memory[p].turn_a = old_memory[old].turn_a;
    memory[p].turn_b = old_memory[old].turn_b;
    memory[p].place = old_memory[old].place;
    for (uint k = 0u; k < ROLLED(MANIFOLD_POINTS); k++) {
        memory[p].anchor_a[k] = old_memory[old].anchor_a[k];
        memory[p].anchor_b[k] = old_memory[old].anchor_b[k];
        memory[p].arm_a[k] = old_memory[old].arm_a[k];
        memory[p].arm_b[k] = old_memory[old].arm_b[k];
    }
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    uint slot = fresh_slots[p], old = recalled[p];
    bool fresh = fresh_slots[p + 1u] != slot;
    if (fresh) remember(p, slot, old);
    else takeOver(p, old);
    touches[p] = (fresh ? manifolds[slot].info.x : old_memory[old].ids.z) != 0u ? 1u : 0u;
}
