// Bodies move for a substep. What contacts did to their spin goes into the angular momentum first, and from it comes the spin.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/rigid.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
UPDATES(1, BodyState, bodies);
READS(2, BodyShape, shapes);
UPDATES(3, SolverBody, solver_bodies);
UPDATES(4, vec4, spins);
layout(push_constant) uniform Push { SolverPush push; };

#include "lib/take_up_spin.glsl"

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    SolverBody s = solver_bodies[b];
    if (s.velocity.w == 0.0) return;
    vec4 from = bodies[b].turn, turn = turnAfter(s.turned, from);
    mat3 own = ownInverseInertia(shapes[b]);
    vec3 momentum = takeUpSpin(b, own, turn, s.spin.xyz);
    turn = turnFreely(vec3(own[0][0], own[1][1], own[2][2]), turn, momentum, push.gravity.w);
    vec3 spin = spinOf(own, turn, momentum);
    mat3 inverse = worldInertia(own, turn);
    s.moved = vec4(s.moved.xyz + push.gravity.w * s.velocity.xyz, inverse[1][2]);
    s.turned = turnAfter(turn, turnBack(from));
    s.spin = vec4(spin, inverse[2][2]);
    s.inertia = vec4(inverse[0][0], inverse[0][1], inverse[0][2], inverse[1][1]);
    solver_bodies[b] = s;
    spins[b] = vec4(spin, 0.0);
}
