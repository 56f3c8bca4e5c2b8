// Bodies of islands that have been at rest for long enough sleep: they are not solved, as if they could not move. Counts the others.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/solver.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, BodyState, bodies);
READS(2, uint, islands);
READS(3, uint, rests);
UPDATES(4, SolverBody, solver_bodies);
layout(push_constant) uniform Push { float sleep_after; }; // s

shared uint awake_here;

// What an island waits for has happened; what never moves is neither awake nor asleep.
bool isAwake(uint b) {
    if (b >= counts[COUNT_BODIES] || bodies[b].offset.w == 0.0) return false;
    bool awake = uintBitsToFloat(rests[islands[b]]) < sleep_after;
    if (!awake) solver_bodies[b] = SolverBody(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0, 0.0, 0.0, 1.0));
    return awake;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) awake_here = 0u;
    barrier();
    if (isAwake(flatIndex())) atomicAdd(awake_here, 1u);
    barrier();
    if (lane == 0u && awake_here != 0u) atomicAdd(counts[COUNT_AWAKE], awake_here);
}
