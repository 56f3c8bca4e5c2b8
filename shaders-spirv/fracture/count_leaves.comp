// How many sites are left at each leaf of the sphere tree, and the leaf's radius with them.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sphere_tree.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, bin_sites);
UPDATES(2, uvec4, tree);
UPDATES(3, uint, path); // from here on the leaf
UPDATES(4, uint, leaf_counts);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_SITES] || counts[COUNT_SITES] < 2u || counts[STATUS_FAILED] != 0u) return;
    uint at = path[p];
    if ((at & PLACED) != 0u) return;
    uvec4 parent = tree[at >> 1];
    uint leaf = childAt(at, parent), initial = initialAt(at, parent);
    path[p] = leaf;
    atomicMax(tree[leaf].w, radiusBits(bin_sites[p].xyz - bin_sites[initial].xyz));
    atomicAdd(leaf_counts[leaf], 1u);
}
