// Pairs of islands of one cell, a pair a lane. Whose boxes lie apart, their colliders do too; the others are to be parted.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/collider.h"
#include "lib/wide.glsl"
#include "lib/support_directions.glsl"
#include "lib/support_plane.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, island_cells); // sorted
READS(2, uint, islands);
READS(3, uint, pair_offsets);
READS(4, int, supports);
WRITES(5, uvec2, island_pairs);
WRITES(6, uint, flags);
#define SORTED island_cells
#define SORTED_COUNT COUNT_FRAGMENTS
#include "lib/sorted_list.glsl"

// The island to which pair p belongs: the last one whose pairs begin no later, of which it has some.
uint islandOf(uint p) {
    uint low = 0u, high = counts[COUNT_FRAGMENTS] - 1u;
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high + 1u) / 2u;
        bool after = pair_offsets[middle] > p;
        low = after ? low : middle;
        high = after ? middle - 1u : high;
    }
    return low;
}

bool boxesApart(uint f, uint g) {
    bool apart = false;
    for (uint k = 0u; k < ROLLED(6); k++) {
        ivec3 n = supportDirection(k), none = ivec3(kGridMiddle);
        int64_t gap = boundAlong(n, supports[f * SUPPORT_DIRECTIONS + k], none) +
                      boundAlong(-n, supports[g * SUPPORT_DIRECTIONS + (k ^ 1u)], none);
        apart = apart || signOf(gap) <= 0;
    }
    return apart;
}

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_ISLAND_PAIRS] || counts[STATUS_FAILED] != 0u) return;
    uint k = islandOf(p), first = firstFrom(island_cells[k]);
    uvec2 pair = uvec2(islands[first + p - pair_offsets[k]], islands[k]);
    island_pairs[p] = pair;
    flags[p] = boxesApart(pair.x, pair.y) ? 0u : 1u;
}
