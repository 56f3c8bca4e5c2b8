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
#include "lib/solver_push.glsl"
#include "lib/solve_contact.glsl"

const uint kMostTurns = 65000u; // of the 65,535 that Mesa's software device allows

void solve(uint c) {
#ifdef BOUNCE
    bounceContact(c);
#else
    solveContact(c);
#endif
}

// Which colors are walked through. Each contact without a color counts as one of its own, from NO_COLOR on.
uvec2 colorsLeft() {
    uint used = color_start[COLORS_ORDERED], lacked = color_start[NO_COLOR + 1u] - color_start[NO_COLOR];
    uint first = color_start[NO_COLOR + 1u] > FEW_CONTACTS ? min(color, used) : 0u;
    return uvec2(lacked != 0u && first == used ? NO_COLOR : first, lacked != 0u ? NO_COLOR + lacked : used);
}

uint colorAfter(uint at) {
    bool last = at + 1u == color_start[COLORS_ORDERED];
    return last && color_start[NO_COLOR] != color_start[NO_COLOR + 1u] ? NO_COLOR : at + 1u;
}

uvec2 colorRange(uint at) {
    uint alone = color_start[NO_COLOR] + at - NO_COLOR, k = min(at, NO_COLOR);
    return at >= NO_COLOR ? uvec2(alone, alone + 1u) : uvec2(color_start[k], color_start[k + 1u]);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (counts[COUNT_BY_COLOR] == 0u) return;
    uvec2 left = colorsLeft();
    // Mesa compiles what comes before a barrier apart from what comes after: without this one, what solves would be there twice.
    barrier();
    for (uint turn = 0u; turn < kMostTurns && left.x < left.y; turn++) {
        uvec2 some = colorRange(left.x);
        for (uint c = some.x + lane; c < some.y; c += LANES) solve(c);
        memoryBarrierBuffer();
        barrier();
        left.x = colorAfter(left.x);
    }
}
