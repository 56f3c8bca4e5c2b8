// Which fragments go in this step, in the order of their slots, and how many workgroups that takes. One workgroup, whose lanes look
// at slots that follow each other.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/debris.h"
#include "shared/pool.h"
#include "shared/solver.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uint, world_args);
UPDATES(2, DebrisClock, clocks);
UPDATES(3, uint, words);
WRITES(4, uint, leaving); // bodies
layout(constant_id = FLAT_SIZE_ID) const uint flat_size = GROUP_SIZE;

shared uint sums[GROUP_SIZE];

bool isOver(uint b) { return clocks[b].offset.w >= float(DEBRIS_OVER); }

void list(uint begin, uint end, uint at) {
    for (uint b = begin; b < end; b++) {
        if (!isOver(b) || at >= MOST_EXPIRING) continue;
        leaving[at++] = b;
        clocks[b].sector.w = DEBRIS_LEAVES;
    }
}

void setGroups(uint at, uvec3 groups) {
    words[at] = groups.x;
    words[at + 1u] = groups.y;
    words[at + 2u] = groups.z;
}

void main() {
    uint lane = gl_LocalInvocationID.x, slots = counts[COUNT_BODIES], share = (slots + GROUP_SIZE - 1u) / GROUP_SIZE;
    uint begin = min(lane * share, slots), end = min(begin + share, slots), own = 0u;
    for (uint b = begin; b < end; b++) own += isOver(b) ? 1u : 0u;
    sums[lane] = own;
    barrier();
    uint before = 0u, total = 0u;
    for (uint k = 0u; k < ROLLED(GROUP_SIZE); k++) {
        before += k < lane ? sums[k] : 0u;
        total += sums[k];
    }
    list(begin, end, before);
    if (lane != 0u) return;
    uint listed = min(total, uint(MOST_EXPIRING)), pairs = 9u * COUNT_BOX_PAIRS;
    words[DEBRIS_LISTED] = listed;
    setGroups(DEBRIS_PAIR_ARGUMENTS, uvec3(world_args[pairs], world_args[pairs + 1u], world_args[pairs + 2u]));
    setGroups(DEBRIS_GO_ARGUMENTS, uvec3((listed + flat_size - 1u) / flat_size, 1u, 1u));
    setGroups(DEBRIS_RETURN_ARGUMENTS, uvec3(POOLS, 1u, 1u));
    setGroups(DEBRIS_TELL_ARGUMENTS, uvec3(1u));
}
