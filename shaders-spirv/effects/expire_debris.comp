// Fragments whose time is over are absent, a lane each, and what they had of the pools is returned.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/body.h"
#include "shared/breaking.h"
#include "shared/debris.h"
#include "shared/hull.h"
#include "shared/pool.h"
#include "shared/solver.h"

FLAT_KERNEL;
READS(0, uint, words);
READS(1, uint, leaving);
READS(2, BodyShape, shapes);
READS(3, HullRecord, hulls);
UPDATES(4, BodyState, bodies);
UPDATES(5, BreakableBody, breakable);
UPDATES(6, PieceRecord, pieces);
UPDATES(7, DebrisClock, clocks);
WRITES(8, PoolShare, returned);
UPDATES(9, uint, steps);
#include "lib/leave_world.glsl"

void main() {
    uint k = flatIndex();
    if (k >= words[DEBRIS_LISTED]) return;
    uint body = leaving[k];
    returned[k] = shareOf(body);
    leaveWorld(body);
    clocks[body] = DebrisClock(ivec4(0), vec4(0.0));
    atomicAdd(steps[STEPS_EXPIRED], 1u);
}
