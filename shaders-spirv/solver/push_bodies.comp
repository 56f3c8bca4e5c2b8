// A substep begins for bodies that no small island holds. In the world's first substep what has contacts is given back the half of
// gravity that begin_step took from its speed.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/effect.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
CONTACTS_EFFECT;
FRICTION_EFFECT;
READS(0, uint, counts);
READS(1, SolverContact, solver_contacts);
READS(2, uint, adjacency_start);
READS(3, uint, adjacency); // a contact << 1, | 1 where the body is its B
UPDATES(4, SolverBody, solver_bodies);
READS(5, uint, steps);
READS(6, uint, islands);
READS(7, uint, island_contacts);
layout(push_constant) uniform Push { SolverPush push_; };
#include "lib/apart.glsl"
#include "lib/push_body.glsl"

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (solver_bodies[b].velocity.w == 0.0 || isApart(b)) return;
    bool lags = steps[STEPS_MADE] == 0u && push_.first_substep != 0u && hasContacts(b);
    pushBody(b, (lags ? 1.5 : 1.0) * push_.gravity.w * push_.gravity.xyz);
}
