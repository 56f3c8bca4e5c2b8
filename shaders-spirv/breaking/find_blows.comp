// Which contacts break what they touch, before they are solved: those of bodies that meet by the end of this step, hard enough for one of
// them or both. How hard is the energy that the two have along the normal when they meet, which depends on no step and no solver.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/breaking_laws.glsl"
#include "lib/break_pattern.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/solver.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ContactMemory, memory);
READS(2, BodyState, bodies);
READS(3, SolverBody, solver_bodies);
READS(4, uint, touches);
READS(5, BreakableBody, breakable);
READS(6, MaterialCard, cards);
READS(7, uint, steps);
WRITES(8, BlowRecord, blows);
UPDATES(9, uint, hardest); // energy of each body's hardest blow, as bits: of floats that are not negative the order is the same
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration; // of the step, s
};
#include "lib/meeting.glsl"
#include "lib/takes_part.glsl"

bool canBreak(uint body) {
    return breakable[body].surface.y > 0u && float(steps[STEPS_MADE]) * duration >= breakable[body].form.w;
}

float impedanceOf(uint body) {
    uint material = breakable[body].surface.w;
    return material != NO_INDEX ? cards[material].elastic.z : float(RIGID_IMPEDANCE);
}

// By the energy of the blow, or, where both break, by half of it each.
bool breaksBody(uint body, uint other, BlowRecord record, float share) {
    if (!canBreak(body)) return false;
    BreakableBody b = breakable[body];
    BodyForm form = formOf(b.form.x, b.form.y);
    MaterialCard card = cards[b.surface.w];
    Blow blow = Blow(record.blow.x, record.blow.y, impedanceOf(other));
    uint spread = spreadOf(uint(b.high.w));
    return breaks(card, form, b.form.z, blow, spread) && paysForTwo(card, form, share * energyOf(blow), spread);
}

uint sidesThatBreak(uvec4 ids, BlowRecord record) {
    bool a = breaksBody(ids.x, ids.y, record, 0.5), b = breaksBody(ids.y, ids.x, record, 0.5);
    if (a && b) return BREAKS_A | BREAKS_B;
    a = a || breaksBody(ids.x, ids.y, record, 1.0);
    b = b || (!a && breaksBody(ids.y, ids.x, record, 1.0));
    return (a ? BREAKS_A : 0u) | (b ? BREAKS_B : 0u);
}

// Where they meet, if they do so before the solver has a say: the middle of the points, as the bodies stand now.
bool meets(uint pair, uvec4 ids, vec3 normal, out BlowRecord record) {
    Pair p = pairNow(pair, ids);
    uint points = min(ids.z, MANIFOLD_POINTS);
    record = BlowRecord(uvec4(0u), vec4(0.0), vec4(0.0), vec4(0.0));
    float separation = 3e38;
    for (uint k = 0u; k < points; k++) {
        record.arm_a.xyz += turned(p.turn_a, memory[pair].anchor_a[k].xyz) / float(points);
        record.arm_b.xyz += turned(p.turn_b, memory[pair].anchor_b[k].xyz) / float(points);
        separation = min(separation, separationNow(pair, k, p, normal));
    }
    vec3 arm_a = record.arm_a.xyz, arm_b = record.arm_b.xyz;
    float yield_ = yieldAlong(p.a, arm_a, normal, normal) + yieldAlong(p.b, arm_b, normal, normal);
    float now = dot(normal, velocityAt(p.b, arm_b) - velocityAt(p.a, arm_a)), then = speedOfMeeting(now, separation, p, normal, gravity);
    float apart = max(separation, 0.0), mean = -0.5 * (now + then);
    if (yield_ <= 0.0 || !(then < 0.0) || apart > mean * (duration + AHEAD_OF_STEP * gravity.w)) return false;
    record.blow = vec4(1.0 / yield_, -then, 0.5 * then * then / yield_, min(apart / (mean * duration), 1.0));
    record.sides.y = floatBitsToUint(apart / (mean * duration));
    return true;
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    blows[p].sides = uvec4(0u);
    if (touches[p] == 0u) return;
    uvec4 ids = memory[p].ids;
    if (ids.z == 0u || !(canBreak(ids.x) || canBreak(ids.y))) return;
    BlowRecord record;
    if (!meets(p, ids, memory[p].normal.xyz, record)) return;
    record.sides.x = sidesThatBreak(ids, record);
    if (record.sides.x == 0u) return;
    blows[p] = record;
    atomicAdd(counts[COUNT_BLOWS], 1u);
    if (takesPart(ids.x)) atomicMax(hardest[ids.x], floatBitsToUint(record.blow.z));
    if (takesPart(ids.y)) atomicMax(hardest[ids.y], floatBitsToUint(record.blow.z));
}
