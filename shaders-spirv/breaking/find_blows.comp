// Which contacts break what they touch, before they are solved: those of bodies that meet by the end of this step, hard enough for one of
// them or both. How hard is the energy that the two have along the normal when they meet, which depends on no step and no solver. Where
// they turn before they meet, all of that is only known once it is known how they will stand then (advance_turning).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/material.h"
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
WRITES(10, TurningBlow, turning); // in any order: each is told of at its pair
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration; // of the step, s
};
#include "lib/judge_blow.glsl"
#include "lib/meeting.glsl"

const float kTurned = 1e-3; // rad: by no more, a blow is the same
// What turns may meet so much later than it seems, and so much faster.
const float kLater = 1.5, kFaster = 1.5;

struct Meeting {
    BlowRecord record;
    float time; // s until then, with points that overlap before now
};

// Where and when they meet if they go on as they do: the middle of the points, as the bodies stand now.
bool meets(uint pair, uvec4 ids, vec3 normal, out Meeting met) {
    Pair p = pairNow(pair, ids);
    uint points = min(ids.z, MANIFOLD_POINTS);
    vec3 arm_a = vec3(0.0), arm_b = vec3(0.0);
    float separation = 3e38;
    for (uint k = 0u; k < points; k++) {
        arm_a += turned(p.turn_a, memory[pair].anchor_a[k].xyz) / float(points);
        arm_b += turned(p.turn_b, memory[pair].anchor_b[k].xyz) / float(points);
        separation = min(separation, separationNow(pair, k, p, normal));
    }
    float yield_ = yieldAlong(p.a, arm_a, normal, normal) + yieldAlong(p.b, arm_b, normal, normal);
    float now = dot(normal, velocityAt(p.b, arm_b) - velocityAt(p.a, arm_a)), then = speedOfMeeting(now, separation, p, normal, gravity);
    float apart = max(separation, 0.0), mean = -0.5 * (now + then);
    if (yield_ <= 0.0 || !(then < 0.0)) return false;
    met = Meeting(blowAt(yield_, -then, apart / (mean * duration), arm_a, arm_b, normal), separation / mean);
    return true;
}

bool turnsUntil(float time, uvec4 ids) {
    float turning_ = length(bodies[ids.x].spin.xyz) + length(bodies[ids.y].spin.xyz);
    return turning_ * min(abs(time), duration) > kTurned;
}

void listTurning(uint pair, uvec4 ids, Meeting met) {
    BlowRecord most = met.record;
    most.blow.yz *= vec2(kFaster, kFaster * kFaster);
    if (sidesThatBreak(ids.xy, most) == 0u) return;
    vec3 own_a = turned(turnBack(bodies[ids.x].turn), met.record.arm_a.xyz), own_b = turned(turnBack(bodies[ids.y].turn), met.record.arm_b.xyz);
    turning[atomicAdd(counts[COUNT_TURNING], 1u)] = TurningBlow(uvec4(pair, ids.xy, 0u), vec4(own_a, 0.0), vec4(own_b, 0.0));
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    blows[p].sides = uvec4(0u);
    if (touches[p] == 0u) return;
    uvec4 ids = memory[p].ids;
    if (ids.z == 0u || !(canBreak(ids.x) || canBreak(ids.y))) return;
    Meeting met;
    if (!meets(p, ids, memory[p].normal.xyz, met)) return;
    float horizon = duration + AHEAD_OF_STEP * gravity.w;
    if (turnsUntil(met.time, ids)) {
        if (met.time <= kLater * horizon) listTurning(p, ids, met);
    } else if (met.time <= horizon) {
        tellBlow(p, ids.xy, met.record);
    }
}
