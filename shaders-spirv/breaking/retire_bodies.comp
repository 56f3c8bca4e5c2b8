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
#include "lib/leave_world.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_BREAKING]) return;
    bool leaves = adopted[k] != 0u && counts[STATUS_FAILED] == 0u;
    returned[k] = PoolShare(uvec4(0u), uvec4(0u));
    if (!leaves) return;
    returned[k] = shareOf(broken[k].ids.x);
    leaveWorld(broken[k].ids.x);
    atomicAdd(steps[STEPS_BROKEN], 1u);
}
