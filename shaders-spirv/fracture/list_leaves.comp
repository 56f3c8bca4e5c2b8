// Gathers the sites that are left at each leaf of the sphere tree, in any order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sphere_tree.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, path);
READS(2, uint, leaf_start);
UPDATES(3, uint, leaf_counts); // counted down
WRITES(4, uint, loose_leaves);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_SITES] || counts[COUNT_SITES] < 2u || counts[STATUS_FAILED] != 0u) return;
    uint leaf = path[p];
    if ((leaf & PLACED) != 0u) return;
    loose_leaves[leaf_start[leaf] + atomicAdd(leaf_counts[leaf], NO_INDEX) - 1u] = p;
}
