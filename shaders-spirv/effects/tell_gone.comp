// Fragments that leave the world in this step go into the ring of breaks, in the order of their slots. One workgroup, none where
// none leave.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/debris.h"
#include "shared/solver.h"

GROUP_KERNEL;
READS(0, uint, words);
READS(1, uint, leaving);
READS(2, BodyState, bodies);
READS(3, BreakableBody, breakable);
READS(4, uint, steps);
UPDATES(5, uint, told); // how many so far
WRITES(6, BreakEvent, ring);
#include "lib/origin.glsl"

BreakEvent eventOf(uint body) {
    BreakEvent event;
    event.what = uvec4(steps[STEPS_MADE], body, NO_INDEX, breakable[body].surface.w);
    event.made = uvec4(0u, WHOLE_GONE, 0u, 0u);
    event.lacked = uvec4(0u);
    event.sector = ivec4(bodies[body].sector.xyz, 0);
    event.offset = vec4(bodies[body].offset.xyz, 0.0);
    event.along = vec4(0.0);
    event.blow = vec4(0.0);
    event.energies = vec4(0.0);
    event.born = uvec4(bornIn(body), 0u, originOf(body), NO_INDEX);
    event.sizes = vec4(0.0);
    return event;
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = told[0], count = words[DEBRIS_LISTED];
    for (uint k = lane; k < count; k += GROUP_SIZE) ring[(first + k) % BREAK_EVENTS] = eventOf(leaving[k]);
    barrier();
    if (lane == 0u) told[0] = first + count;
}
