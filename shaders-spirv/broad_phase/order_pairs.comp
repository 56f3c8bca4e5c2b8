// Pairs of one first piece by their second, in lists that are not long: each goes behind those that are less.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/broad_phase.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, pair_offsets);
READS(2, uvec2, loose_pairs);
WRITES(3, uvec2, pairs);

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TREE_PAIRS]) return;
    uvec2 pair = loose_pairs[k];
    uint first = pair_offsets[pair.x], end = pair_offsets[pair.x + 1u], rank = 0u;
    if (end - first > LONG_LIST) return;
    for (uint other = first; other < end; other++) rank += loose_pairs[other].y < pair.y ? 1u : 0u;
    pairs[first + rank] = pair;
}
