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
#define LOOSE loose_leaves
#include "lib/rank.glsl"

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_SITES] || counts[COUNT_SITES] < 2u || counts[STATUS_FAILED] != 0u) return;
    uint leaf = path[p];
    if ((leaf & PLACED) != 0u) return;
    uint first = leaf_start[leaf];
    leaf_sites[first + rankIn(first, leaf_start[leaf + 1u], p)] = p;
}
