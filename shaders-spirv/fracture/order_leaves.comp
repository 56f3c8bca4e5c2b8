// Puts the sites of each leaf in order, so that nothing later depends on which lane came first.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sphere_tree.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, path);
READS(2, uint, leaf_start);
READS(3, uint, loose_leaves);
WRITES(4, uint, leaf_sites);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_SITES] || counts[COUNT_SITES] < 2u || counts[STATUS_FAILED] != 0u) return;
    uint leaf = path[p];
    if ((leaf & PLACED) != 0u) return;
    uint first = leaf_start[leaf], last = leaf_start[leaf + 1u], rank = 0u;
    if (last - first > MOST_IN_A_BIN) {
        atomicMax(counts[STATUS_CROWDED], last - first);
        atomicOr(counts[STATUS_FAILED], FAILED_CELLS);
    }
    last = min(last, first + MOST_IN_A_BIN);
    for (uint k = first; k < last; k++) rank += loose_leaves[k] < p ? 1u : 0u;
    leaf_sites[first + rank] = p;
}
