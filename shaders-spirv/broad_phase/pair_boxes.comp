// A lane a leaf: what of the leaves to its right it meets. Boxes that do not move stand at the right end and look for nothing,
// so no pair is found twice, and a large one among small ones is found by each of these instead of finding them all.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/box.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, nodes);
READS(2, uvec4, box_high);
UPDATES(3, uint, pair_counts); // of each piece, in how many pairs it comes first
WRITES(4, uint, found_pairs);  // a, b, and how many of a's were found before
layout(push_constant) uniform Push {
    uint box_capacity;
    uint pair_capacity;
    uint turn_budget;
};
#include "lib/box_tree.glsl"

// In any order; place_pairs and order_pairs put them in order. What there is no room for is counted all the same.
void note(uint one, uint other) {
    uint a = min(one, other), at = atomicAdd(counts[COUNT_FOUND_PAIRS], 1u), rank = atomicAdd(pair_counts[a], 1u);
    if (at >= pair_capacity) return;
    found_pairs[3u * at] = a;
    found_pairs[3u * at + 1u] = max(one, other);
    found_pairs[3u * at + 2u] = rank;
}

void main() {
    uint n = counts[COUNT_TREE_BOXES], leaf = flatIndex();
    if (leaf >= n || counts[STATUS_FAILED] != 0u) return;
    uint at = 2u * nodeAt(leaf, 0u);
    Box box = Box(nodes[at], nodes[at + 1u]);
    uint piece = box.high.w, p = leaf + 1u, level = levelAt(p);
    if ((box_high[piece].w & (BOX_STATIC | BOX_ABSENT)) != 0u) return;
    for (uint turn = 0u; turn < turn_budget && p < n; turn++) {
        at = 2u * nodeAt(p, level);
        Box node = Box(nodes[at], nodes[at + 1u]);
        bool meets = meet(box, node) && node.low.w != box.low.w, inner = level > 0u;
        if (meets && !inner) note(piece, node.high.w);
        bool enter = meets && inner;
        p += enter ? 0u : 1u << level;
        level = enter ? level - 2u : levelAt(p);
    }
    if (p < n) atomicOr(counts[STATUS_FAILED], FAILED_PAIRING);
}
