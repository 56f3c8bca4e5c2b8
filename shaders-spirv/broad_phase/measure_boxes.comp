// The extent of the centers of all boxes, and how large those are that move: greatest numbers and sums of whole ones, whatever
// comes first.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/box.glsl"
#include "lib/ordered_float.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, box_low);
READS(2, uvec4, box_high);
UPDATES(3, uint, extent);
#define PER_LANE (SCAN_BLOCK / GROUP_SIZE)

shared uint words[EXTENT_WORDS];

void main() {
    uint n = counts[COUNT_TREE_BOXES], lane = gl_LocalInvocationID.x, block = flatGroup() * SCAN_BLOCK;
    if (lane < EXTENT_WORDS) words[lane] = 0u;
    uvec3 below = uvec3(0), above = uvec3(0);
    uint sizes = 0u, moving = 0u;
    for (uint k = 0u; k < ROLLED(PER_LANE); k++) {
        uint piece = block + k * GROUP_SIZE + lane;
        Box box = kNoBox;
        if (piece < n) box = checkedBox(box_low[piece], box_high[piece]);
        uvec3 center = orderedBits(centerOf(box));
        below = isAbsent(box) ? below : max(below, ~center);
        above = isAbsent(box) ? above : max(above, center);
        bool moves = !isAbsent(box) && !isStatic(box);
        sizes += moves ? sizeOf(box) : 0u;
        moving += moves ? 1u : 0u;
    }
    barrier();
    for (uint axis = 0u; axis < 3u; axis++) {
        atomicMax(words[EXTENT_BELOW + axis], below[axis]);
        atomicMax(words[EXTENT_ABOVE + axis], above[axis]);
    }
    atomicAdd(words[EXTENT_SIZES], sizes);
    atomicAdd(words[EXTENT_MOVING], moving);
    barrier();
    if (lane < EXTENT_SIZES) atomicMax(extent[lane], words[lane]);
    else if (lane < EXTENT_WORDS) atomicAdd(extent[lane], words[lane]);
}
