// The contacts of one color, a lane a contact: no two of them share a body that moves.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, color_start);
UPDATES(1, SolverContact, solver_contacts);
UPDATES(2, SolverBody, solver_bodies);
#include "lib/solver_push.glsl"
#include "lib/solve_contact.glsl"

void main() {
    uint c = color_start[color] + flatIndex();
    if (c >= color_start[color + 1u]) return;
#ifdef BOUNCE
    bounceContact(c);
#else
    solveContact(c);
#endif
}
