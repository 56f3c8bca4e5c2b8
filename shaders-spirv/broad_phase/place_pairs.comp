// Gathers pairs by their first piece, in each list in the order in which they were found.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, found_pairs);
READS(2, uint, pair_offsets);
WRITES(3, uvec2, loose_pairs);
WRITES(4, uint, long_lists); // pieces, in any order

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TREE_PAIRS]) return;
    uint a = found_pairs[3u * k], rank = found_pairs[3u * k + 2u];
    loose_pairs[pair_offsets[a] + rank] = uvec2(a, found_pairs[3u * k + 1u]);
    if (rank == LONG_LIST) long_lists[atomicAdd(counts[COUNT_LONG_LISTS], 1u)] = a;
}
