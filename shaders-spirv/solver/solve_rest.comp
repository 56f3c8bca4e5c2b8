// The contacts of all colors that are not dispatched on their own, color by color, by one workgroup. What has no color goes one by
// one in the end.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, color_start);
UPDATES(2, SolverContact, solver_contacts);
UPDATES(3, SolverBody, solver_bodies);
layout(push_constant) uniform Push {
    vec4 gravity;
    vec4 soft;
    vec4 stiff;
    uint color;
    uint with_push;
    uint bodies;
    uint pad;
};
#include "lib/solve_contact.glsl"

void solve(uint c) {
#ifdef BOUNCE
    bounceContact(c);
#else
    solveContact(c);
#endif
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = counts[COUNT_CONTACTS] > FEW_CONTACTS ? color : 0u;
    for (uint k = first; k < COLORS; k++) {
        uint begin = color_start[k], end = color_start[k + 1u];
        if (begin == end) continue; // the same for all lanes
        for (uint c = begin + lane; c < end; c += GROUP_SIZE) solve(c);
        memoryBarrierBuffer();
        barrier();
    }
    uint begin = color_start[NO_COLOR], end = color_start[NO_COLOR + 1u];
    for (uint c = begin; lane == 0u && c < end; c++) solve(c);
}
