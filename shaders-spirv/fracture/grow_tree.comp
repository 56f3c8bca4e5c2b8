// One level of the sphere tree, second half: the best site of each side becomes a node there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sphere_tree.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, bin_sites);
UPDATES(2, uvec4, tree);
UPDATES(3, uint, path);
READS(4, uint, bids);

void main() {
    uint p = flatIndex();
    if (p >= counts[COUNT_SITES] || counts[COUNT_SITES] < 2u || counts[STATUS_FAILED] != 0u) return;
    uint at = path[p];
    if ((at & PLACED) != 0u || bids[at] != NO_INDEX - mixed(p)) return;
    uint node = at >> 1, initial = initialAt(at, tree[node]);
    tree[p].x = initial;
    if ((at & 1u) != 0u) tree[node].z = p + 1u;
    else tree[node].y = p + 1u;
    atomicMax(tree[p].w, radiusBits(bin_sites[p].xyz - bin_sites[initial].xyz));
    path[p] = PLACED;
}
