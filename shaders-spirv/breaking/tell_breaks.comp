// What has broken in a step, or could not, goes into a ring that the host reads when it likes: the oldest are overwritten. One
// workgroup.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/quaternion.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/material.h"
#include "shared/solver.h"
#include "lib/sector.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BrokenBody, broken);
READS(2, CrackLedger, ledger);
READS(3, uint, owner_start);
READS(4, BodyState, bodies);
READS(5, BreakableBody, breakable);
READS(6, uint, steps);
UPDATES(7, uint, told); // how many so far
WRITES(8, BreakEvent, ring);
READS(9, uvec4, lacking);
READS(10, SizeShare, sizes);
READS(11, MaterialCard, cards);

// The first count of the event that was more than there is room for, and how much.
uvec2 firstNeeded() {
    for (uint k = 0u; k < uint(COUNT_TOTAL); k++)
        if (counts[STATUS_NEEDED + k] != 0u) return uvec2(k, counts[STATUS_NEEDED + k]);
    return uvec2(0u);
}

// What there was no room to try stands behind all that were tried.
uint whyWhole(uint k) { return k < counts[COUNT_BREAKING] ? ledger[k].outcome.x : counts[STATUS_UNFIT]; }

// What does not move weighs as its material does.
float densityOf(uint body) {
    float inverse_mass = bodies[body].offset.w;
    return inverse_mass > 0.0 ? 1.0 / (inverse_mass * breakable[body].form.x) : cards[breakable[body].surface.w].elastic.x;
}

#include "lib/origin.glsl"

BreakEvent eventOf(uint k) {
    BrokenBody hit = broken[k];
    uint body = hit.ids.x;
    uint why = whyWhole(k);
    vec3 offset = bodies[body].offset.xyz + turned(bodies[body].turn, hit.place.xyz);
    ivec3 sectors = sectorsIn(offset);
    BreakEvent event;
    event.what = uvec4(steps[STEPS_MADE], body, hit.ids.y, breakable[body].surface.w);
    uint cells = why == 0u ? owner_start[k + 1u] - owner_start[k] : 0u, small = why == 0u ? uint(sizes[k].dust_cells) : 0u;
    event.made = uvec4(cells - small, why, why == WHOLE_FAILED ? firstNeeded() : uvec2(why == 0u ? ledger[k].outcome.y : 0u, 0u));
    bool untried = k >= counts[COUNT_BREAKING];
    event.lacked = untried ? uvec4(hit.share.zw, 0u, 0u) : why == WHOLE_NO_ROOM ? lacking[k] : uvec4(0u);
    event.sector = ivec4(bodies[body].sector.xyz + sectors, int(small));
    event.offset = vec4(offsetWithin(offset, sectors), why == 0u ? densityOf(body) * sizes[k].dust : 0.0);
    event.along = vec4(hit.along.xyz, hit.share.y);
    event.blow = hit.blow;
    event.energies = why == 0u ? ledger[k].energies : vec4(0.0);
    event.born = uvec4(bornIn(body), 0u, originOf(body), NO_INDEX);
    if (hit.ids.y != NO_INDEX) event.born.yw = uvec2(bornIn(hit.ids.y), originOf(hit.ids.y));
    event.sizes = vec4(why == 0u ? densityOf(body) * vec2(sizes[k].largest, sizes[k].smallest) : vec2(0.0), 0.0, 0.0);
    return event;
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = told[0];
    uint count = min(counts[COUNT_BREAKING] + (counts[STATUS_UNFIT] != 0u ? 1u : 0u), uint(MOST_BREAKING));
    for (uint k = lane; k < count; k += GROUP_SIZE) ring[(first + k) % BREAK_EVENTS] = eventOf(k);
    barrier();
    if (lane == 0u) told[0] = first + count;
}
