// Bodies that no small island holds move for a substep.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/effect.glsl"
#include "lib/rigid.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
CONTACTS_EFFECT;
READS(0, uint, counts);
UPDATES(1, BodyState, bodies);
READS(2, BodyShape, shapes);
UPDATES(3, SolverBody, solver_bodies);
UPDATES(4, vec4, spins);
READS(5, uint, islands);
READS(6, uint, island_contacts);
READS(7, uint, adjacency_start);
layout(push_constant) uniform Push { SolverPush push_; };
#include "lib/apart.glsl"
#include "lib/move_body.glsl"

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (solver_bodies[b].velocity.w != 0.0 && !isApart(b)) moveBody(b, push_.gravity.w);
}
