// Which contacts break what they touch, before they are solved: those of bodies that meet in this step, hard enough for one of
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
UPDATES(4, uint, touches);
READS(5, BreakableBody, breakable);
READS(6, MaterialCard, cards);
READS(7, uint, steps);
WRITES(8, BlowRecord, blows);
WRITES(9, TurningBlow, turning); // in any order: each is told of at its pair
READS(10, BodyShape, shapes);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration; // of the step, s
};
#include "lib/blow_place.glsl"
#include "lib/component.glsl"
#include "lib/judge_blow.glsl"
#include "lib/meeting.glsl"
#include "lib/most_closing.glsl"

const float kNever = 3e38;
const float kTurned = 1e-3; // rad: by no more, a blow is the same
// What turns may meet so much later than it seems, and so much faster.
const float kLater = 1.5, kFaster = 1.5;
const float kSwift = 0.1; // rad in a step: what turns by more may meet though it has no points yet

struct Meeting {
    BlowRecord record;
    float separation;
    float closing; // m/s, on the way until then
};

// s until then, with points that overlap before now.
float timeOf(Meeting met) { return met.separation / met.closing; }

// rad, of both together.
float turnIn(float time, uvec4 ids) { return (length(bodies[ids.x].spin.xyz) + length(bodies[ids.y].spin.xyz)) * time; }

bool turns(uvec4 ids) { return turnIn(duration, ids) > kTurned; }
bool isSwift(uvec4 ids) { return turnIn(duration, ids) > kSwift; }

// What turns may come in faster than it seems.
BlowRecord mostOf(BlowRecord record, uvec4 ids) {
    if (turns(ids)) record.blow.yz *= vec2(kFaster, kFaster * kFaster);
    return record;
}

// Of a layer of their points; none where these do not come closer.
bool layerMeets(uint pair, uvec4 ids, Pair p, vec3 normal, vec4 separations, vec4 closings, inout float limit, out Meeting met) {
    float separation;
    uint points = min(ids.z, MANIFOLD_POINTS);
    vec4 weights = weightsOf(separations, closings, limit, separation);
    vec3 arm_a = vec3(0.0), arm_b = vec3(0.0);
    for (uint k = 0u; k < points; k++) {
        arm_a += weights[k] * armOfA(pair, k, p);
        arm_b += weights[k] * armOfB(pair, k, p);
    }
    roundArms(ids.xy, normal, arm_a, arm_b);
    float yield_ = yieldAlong(p.a, arm_a, normal, normal) + yieldAlong(p.b, arm_b, normal, normal);
    float now = partingAt(p, arm_a, arm_b, normal), then = speedOfMeeting(now, separation, p, normal, gravity);
    float apart = max(separation, 0.0), mean = -0.5 * (now + then);
    if (yield_ <= 0.0 || !(then < 0.0)) return false;
    met = Meeting(blowAt(yield_, -then, apart / (mean * duration), arm_a, arm_b, normal), separation, mean);
    return true;
}

bool isBefore(Meeting a, Meeting b) { return isSooner(a.separation, a.closing, b.separation, b.closing); }

// Where and when they meet if they go on as they do, as the bodies stand now.
bool meets(uint pair, uvec4 ids, vec3 normal, out Meeting met) {
    Pair p = pairNow(pair, ids);
    uint points = min(ids.z, MANIFOLD_POINTS);
    vec4 separations = vec4(0.0), closings = vec4(kNoPoint);
    for (uint k = 0u; k < points; k++) {
        separations = withComponent(separations, k, separationNow(pair, k, p, normal));
        closings = withComponent(closings, k, -partingAt(p, armOfA(pair, k, p), armOfB(pair, k, p), normal));
    }
    bool any_ = false;
    float limit = kNoLimit;
    for (uint k = 0u; k < kLayers && isLayer(k, closings, limit); k++) {
        Meeting next;
        if (!layerMeets(pair, ids, p, normal, separations, closings, limit, next)) break;
        if (!any_ || (isBefore(next, met) && sidesThatBreak(ids.xy, mostOf(next.record, ids)) != 0u)) met = next;
        any_ = true;
    }
    return any_;
}

// What may become of two that turn: the hardest blow, and what is known of when they meet, as in TurningBlow.
struct Prospect {
    BlowRecord most;
    vec3 time;
    bool comes;
};

Prospect prospectOf(uvec4 ids, Meeting met) {
    return Prospect(mostOf(met.record, ids), vec3(timeOf(met), 0.0, max(met.separation, 0.0)), timeOf(met) <= kLater * horizon());
}

// Where they will touch by then, if they do, may be nowhere near the points that they have now.
Prospect swiftProspectOf(uint p, uvec4 ids, bool is_met, Meeting met) {
    float speed = mostClosing(ids.x, ids.y, vec3(0.0), gravity.xyz, duration);
    float least_yield = solver_bodies[ids.x].velocity.w + solver_bodies[ids.y].velocity.w;
    float soonest = ids.z == 0u ? memory[p].place.w / speed : 0.0;
    vec3 time = is_met ? vec3(min(timeOf(met), horizon()), 0.0, max(met.separation, 0.0)) : vec3(soonest, 0.0, 0.0);
    return Prospect(blowAt(least_yield, speed, 0.0, vec3(0.0), vec3(0.0), vec3(0.0)), time, soonest <= horizon());
}

void listTurning(uint pair, uvec4 ids, Prospect prospect) {
    if (!prospect.comes || sidesThatBreak(ids.xy, prospect.most) == 0u) return;
    turning[atomicAdd(counts[COUNT_TURNING], 1u)] = TurningBlow(uvec4(pair, ids.xy, 0u), vec4(prospect.time, 0.0));
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_BOX_PAIRS]) return;
    blows[p].sides = uvec4(0u, floatBitsToUint(kNever), 0u, 0u);
    uvec4 ids = memory[p].ids;
    if (!(canBreak(ids.x) || canBreak(ids.y)) || (ids.z != 0u && touches[p] == 0u)) return;
    Meeting met;
    bool is_met = ids.z != 0u && meets(p, ids, memory[p].normal.xyz, met), is_swift = isSwift(ids);
    if (is_swift || (is_met && turns(ids))) listTurning(p, ids, is_swift ? swiftProspectOf(p, ids, is_met, met) : prospectOf(ids, met));
    else if (is_met && timeOf(met) <= horizon()) tellBlow(p, ids.xy, met.record, timeOf(met));
}
