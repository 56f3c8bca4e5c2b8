// For how long bodies have hardly moved, and which of them slept in this step.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, BodyState, bodies);
READS(2, BodyShape, shapes);
READS(3, SolverBody, solver_bodies);
UPDATES(4, uint, steps);
layout(push_constant) uniform Push { float dt, sleep_speed; };

const float kLongest = 1e6; // s

// By the way in this step: the speed at its end has in it what the last pass over contacts left undone, which moves nothing. A tenth
// of a small body's radius a second is as much to it as sleep_speed is to a large one.
bool hardlyMoves(uint b) {
    float radius = shapes[b].inverse_inertia[2].w;
    float way = length(solver_bodies[b].moved.xyz) + 2.0 * radius * length(solver_bodies[b].turned.xyz);
    return way < dt * min(sleep_speed, 0.1 * radius);
}

// What nothing bears goes on for ever, however slowly.
bool isBorne(uint b) {
    bool stays = solver_bodies[b].moved.xyz == vec3(0.0) && solver_bodies[b].turned.xyz == vec3(0.0);
    return stays || (bodies[b].sector.w & BODY_BORNE) != 0;
}

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (b == 0u) steps[STEPS_ASLEEP] = counts[COUNT_AWAKE] == 0u ? min(steps[STEPS_ASLEEP] + 1u, IDLE_STEPS) : 0u;
    if (bodies[b].offset.w == 0.0) return;
    bool asleep = solver_bodies[b].velocity.w == 0.0;
    bodies[b].sector.w = asleep ? bodies[b].sector.w | BODY_ASLEEP : bodies[b].sector.w & ~BODY_ASLEEP;
    if (asleep) {
        bodies[b].velocity.xyz = vec3(0.0);
        bodies[b].spin.xyz = vec3(0.0);
        bodies[b].momentum.xyz = vec3(0.0);
    } else bodies[b].velocity.w = hardlyMoves(b) && isBorne(b) ? min(bodies[b].velocity.w + dt, kLongest) : 0.0;
}
