// What the blows of bodies that turn break, now that it is known how they stand when they meet.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/contact.h"
#include "shared/material.h"
#include "shared/solver.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, TurningBlow, turning);
READS(2, Manifold, manifolds);
READS(3, BodyState, bodies);
READS(4, BodyShape, shapes);
READS(5, SolverBody, solver_bodies);
READS(6, BreakableBody, breakable);
READS(7, MaterialCard, cards);
READS(8, uint, steps);
UPDATES(9, BlowRecord, blows);
READS(10, ContactMemory, memory);
UPDATES(11, uint, touches);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration; // of the step, s
    float margin; // m, of contacts
};
#include "lib/judge_blow.glsl"
#include "lib/turning_contact.glsl"

// As the body stands now.
vec3 armNow(uint body, Flight f, vec3 arm) { return turned(bodies[body].turn, turned(turnBack(f.turn), arm)); }

// What is sure not to meet in this step is not solved either: the solver takes points for those of a straight way, and would have them
// meet too early.
void leave(uint pair) {
    uvec4 ids = memory[pair].ids;
    float separation = 3e38;
    for (uint k = 0u; k < MANIFOLD_POINTS && k < ids.z; k++) separation = min(separation, memory[pair].arm_a[k].w);
    if (separation > margin) touches[pair] = 0u;
}

void judge(uint k, TurningBlow t, TurningContact c, float time) {
    vec3 normal = manifolds[k].normal.xyz;
    float yield_ = yieldOf(c, t, normal);
    if (yield_ <= 0.0) return;
    vec3 arm_a = armNow(t.ids.y, c.a, c.arm_a), arm_b = armNow(t.ids.z, c.b, c.arm_b);
    tellBlow(t.ids.x, t.ids.yz, blowAt(yield_, c.closing, max(time, 0.0) / duration, arm_a, arm_b, normal), time);
}

void judgePoints(uint k, TurningBlow t) {
    TurningContact c = contactOf(k, t);
    bool comes = c.closing > 0.0;
    float time = comes ? meetingTime(c, t) : t.time.x;
    if (min(time, c.soonest) > horizon()) leave(t.ids.x);
    else if (comes && time <= horizon()) judge(k, t, c, time);
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TURNING]) return;
    TurningBlow t = turning[k];
    if (t.ids.w == 0u && manifolds[k].info.x != 0u) judgePoints(k, t);
    else if (t.time.x > horizon()) leave(t.ids.x);
}
