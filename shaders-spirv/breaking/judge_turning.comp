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
UPDATES(10, uint, hardest);
layout(push_constant) uniform Push {
    vec4 gravity; // w: length of a substep, s
    float duration;
};
#include "lib/judge_blow.glsl"
#include "lib/turning_contact.glsl"

float yieldOf(uint body, Flight f, vec3 arm, vec3 normal) {
    if (!movesOf(body)) return 0.0;
    return solver_bodies[body].velocity.w + turningYield(worldInertia(ownInverseInertia(shapes[body]), f.turn), arm, normal);
}

// As the body stands now.
vec3 armNow(uint body, Flight f, vec3 arm) { return turned(bodies[body].turn, turned(turnBack(f.turn), arm)); }

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TURNING]) return;
    TurningBlow t = turning[k];
    if (t.ids.w != 0u || manifolds[k].info.x == 0u) return;
    TurningContact c = contactOf(k, t);
    vec3 normal = manifolds[k].normal.xyz;
    float yield_ = yieldOf(t.ids.y, c.a, c.middle_a, normal) + yieldOf(t.ids.z, c.b, c.middle_b, normal);
    float speed = -dot(normal, velocityAt(c.b, c.middle_b) - velocityAt(c.a, c.middle_a));
    if (c.closing <= 0.0 || speed <= 0.0 || yield_ <= 0.0) return;
    float time = t.arm_a.w + c.separation / c.closing;
    if (time > duration + AHEAD_OF_STEP * gravity.w) return;
    vec3 arm_a = armNow(t.ids.y, c.a, c.middle_a), arm_b = armNow(t.ids.z, c.b, c.middle_b);
    tellBlow(t.ids.x, t.ids.yz, blowAt(yield_, speed, max(time, 0.0) / duration, arm_a, arm_b, normal));
}
