// Bodies that their fragments have taken the place of are absent, a lane an object, and what they had of the pools is returned;
// nothing for those that stay whole.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/hull.h"
#include "shared/pool.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BrokenBody, broken);
READS(2, uint, adopted);
READS(3, BodyShape, shapes);
READS(4, HullRecord, hulls);
UPDATES(5, BodyState, bodies);
UPDATES(6, BreakableBody, breakable);
UPDATES(7, PieceRecord, pieces);
WRITES(8, PoolShare, returned);
UPDATES(9, uint, steps);
#include "lib/face_room.glsl"

// Hulls of a body follow each other.
PoolShare shareOf(uint body) {
    uvec2 range = shapes[body].pieces.xy;
    uvec4 surface = breakable[body].surface;
    HullRecord first = hulls[pieces[range.x].ids.x], last = hulls[pieces[range.x + range.y - 1u].ids.x];
    PoolShare share;
    share.begin = uvec4(body, range.x, first.first.y, surface.x / 3u);
    share.size = uvec4(1u, range.y, last.first.y + faceRoom(last.count) - first.first.y, (surface.y + surface.z) / 3u);
    return share;
}

void retire(uint body) {
    uvec2 range = shapes[body].pieces.xy;
    for (uint p = 0u; p < range.y; p++) pieces[range.x + p].ids.y = NO_INDEX;
    breakable[body].surface = uvec4(0u, 0u, 0u, NO_INDEX);
    bodies[body].sector.w = BODY_ABSENT;
    bodies[body].offset.w = 0.0;
    bodies[body].velocity = vec4(0.0);
    bodies[body].spin = vec4(0.0);
    bodies[body].momentum = vec4(0.0);
}

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_BREAKING]) return;
    bool leaves = adopted[k] != 0u && counts[STATUS_FAILED] == 0u;
    returned[k] = PoolShare(uvec4(0u), uvec4(0u));
    if (!leaves) return;
    returned[k] = shareOf(broken[k].ids.x);
    retire(broken[k].ids.x);
    atomicAdd(steps[STEPS_BROKEN], 1u);
}
