// For how long fragments have been at rest, and whose time is over. The time of small ones runs out: what has begun to fade goes,
// whatever moves it, and while there is any, the world goes on, though all may sleep. Larger ones never fade.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/debris.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BodyState, bodies);
READS(2, BreakableBody, breakable);
UPDATES(3, uint, steps);
UPDATES(4, DebrisClock, clocks);
WRITES(5, uint, words);
layout(push_constant) uniform Push {
    float duration; // of a step
    float speed;    // below which a center of mass is at rest
    float below;    // m3, of those whose time runs out; 0: it runs out for none
    float after, fade; // s
};
#include "lib/origin.glsl"

// By the way that it has gone, whatever it was held back from. Turning counts for nothing: splinters may spin where they lie.
float restOf(BodyState body, DebrisClock clock, bool goes) {
    float rest = clock.offset.w;
    vec3 way = vec3(body.sector.xyz - clock.sector.xyz) * float(SECTOR_EDGE) + (body.offset.xyz - clock.offset.xyz);
    bool fades = goes && rest > 0.0 && rest >= after;
    float longer = fades || length(way) < duration * speed ? rest + duration : 0.0;
    return goes ? longer : min(longer, after);
}

void main() {
    uint b = flatIndex();
    if (b >= counts[COUNT_BODIES] || counts[STATUS_FAILED] != 0u) return;
    if (!isFragment(b)) {
        clocks[b] = DebrisClock(ivec4(0), vec4(0.0));
        return;
    }
    bool goes = breakable[b].form.x < below;
    if (goes) steps[STEPS_ASLEEP] = 0u; // all say the same
    int made = int(bornIn(b));
    BodyState body = bodies[b];
    float rest = clocks[b].sector.w == made ? restOf(body, clocks[b], goes) : 0.0;
    bool is_over = goes && rest > 0.0 && rest >= after + fade;
    clocks[b] = DebrisClock(ivec4(body.sector.xyz, made), vec4(body.offset.xyz, is_over ? float(DEBRIS_OVER) : rest));
    if (!is_over) return;
    for (uint k = 0u; k < 3u; k++) words[DEBRIS_LIST_ARGUMENTS + k] = 1u; // as above
}
