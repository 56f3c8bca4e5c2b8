// The contacts of all colors that are not dispatched on their own, color by color, by one workgroup. What has no color goes one by
// one in the end. Few lanes where they run in turn: a color seldom has work for many, and idle ones cost as much there.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/solver.h"

#ifndef LANES
#define LANES 8u
#endif

layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, uint, color_start);
UPDATES(2, SolverContact, solver_contacts);
UPDATES(3, SolverBody, solver_bodies);
#include "lib/solve_contact.glsl"

void solve(uint c) {
#ifdef BOUNCE
    bounceContact(c);
#else
    solveContact(c);
#endif
}

void solveColor(uint color_, uint lane) {
    uint begin = color_start[color_], end = color_start[color_ + 1u];
    if (begin == end) return; // the same for all lanes
    for (uint c = begin + lane; c < end; c += LANES) solve(c);
    memoryBarrierBuffer();
    barrier();
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = counts[COUNT_CONTACTS] > FEW_CONTACTS ? color : 0u;
    for (uint k = first; k < COLORS; k++) solveColor(k, lane);
    uint begin = color_start[NO_COLOR], end = color_start[NO_COLOR + 1u];
    for (uint c = begin; lane == 0u && c < end; c++) solve(c);
}
