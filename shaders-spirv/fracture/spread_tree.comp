// One level of the sphere tree, first half: every site goes to the nearer side of the node it has come to, and bids for the
// place there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/sphere_tree.glsl"
#include "lib/wide.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, bin_sites);
UPDATES(2, uvec4, tree);
UPDATES(3, uint, path);
UPDATES(4, uint, bids); // the best of each side of each node, as NO_INDEX - priority
layout(push_constant) uniform Push { uint level; };

void main() {
    uint p = flatIndex(), total = counts[COUNT_SITES];
    if (p >= total || total < 2u || counts[STATUS_FAILED] != 0u) return;
    uvec2 root = rootOf(total);
    uint before = path[p];
    if (level == 0u && (p == root.x || p == root.y)) {
        path[p] = PLACED;
        if (p == root.y) {
            tree[p].x = root.x;
            atomicMax(tree[p].w, radiusBits(bin_sites[p].xyz - bin_sites[root.x].xyz));
        }
        return;
    }
    if ((before & PLACED) != 0u) return;
    uvec4 parent = tree[before >> 1];
    uint node = level == 0u ? root.y : childAt(before, parent);
    uint initial = level == 0u ? root.x : tree[node].x;
    ivec3 here = bin_sites[p].xyz, to_initial = here - bin_sites[initial].xyz, to_inserted = here - bin_sites[node].xyz;
    uint side = isNegative(squaredLength(to_inserted) - squaredLength(to_initial)) ? 1u : 0u;
    path[p] = 2u * node + side;
    atomicMax(tree[node].w, radiusBits(to_initial));
    atomicMax(bids[2u * node + side], NO_INDEX - mixed(p));
}
