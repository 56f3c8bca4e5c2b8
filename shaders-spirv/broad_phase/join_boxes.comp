// The nodes over a block of JOIN_BLOCK leaves, or of nodes that an earlier dispatch has made: two levels by each lane alone, three
// by the workgroup. All five are whole blocks in one order, so nobody waits for another workgroup.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/box.glsl"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, box_low);
READS(2, uvec4, box_high);
READS(3, uint, order);
UPDATES(4, uvec4, nodes);
layout(push_constant) uniform Push {
    uint box_capacity;
    uint base;        // level of what is joined: 0, JOIN_BITS
    uint order_first; // where the order begins in its list
};
#include "lib/box_tree.glsl"

shared Box joined[GROUP_SIZE];
uint n;

Box nodeOf(uint p, uint level) {
    uint at = 2u * nodeAt(p, level);
    return Box(nodes[at], nodes[at + 1u]);
}

void writeNode(uint p, uint level, Box box) {
    if (p >= n || (1u << level) >= n) return;
    uint at = 2u * nodeAt(p, level);
    nodes[at] = box.low;
    nodes[at + 1u] = box.high;
}

Box join(Box a, Box b) {
    uvec3 low = floatBitsToUint(min(lowOf(a), lowOf(b))), high = floatBitsToUint(max(highOf(a), highOf(b)));
    bool one_body = a.low.w == b.low.w || isAbsent(b);
    uint body = isAbsent(a) ? b.low.w : (one_body ? a.low.w : NO_BODY);
    return Box(uvec4(low, body), uvec4(high, a.high.w & b.high.w & BOX_ABSENT));
}

// What there is to join: a leaf is written down first.
Box takeBox(uint p) {
    if (p >= n) return kNoBox;
    if (base > 0u) return nodeOf(p, base);
    uint piece = order[order_first + p];
    Box box = checkedBox(box_low[piece], box_high[piece]);
    uint at = 2u * nodeAt(p, 0u);
    nodes[at] = box.low;
    nodes[at + 1u] = uvec4(box.high.xyz, piece);
    return box;
}

Box joinFour(uint p) {
    Box box = kNoBox;
    for (uint k = 0u; k < ROLLED(4); k++) box = join(box, takeBox(p + (k << base)));
    writeNode(p, base + 2u, box);
    return box;
}

Box joinSixteen(uint p) {
    Box box = kNoBox;
    for (uint k = 0u; k < ROLLED(4); k++) box = join(box, joinFour(p + (k << (base + 2u))));
    writeNode(p, base + 4u, box);
    return box;
}

void main() {
    n = counts[COUNT_TREE_BOXES];
    if (base > 0u && (1u << base) >= n) return; // the first dispatch has made all there is to make
    uint lane = gl_LocalInvocationID.x, first = (flatGroup() * JOIN_BLOCK) << base;
    joined[lane] = joinSixteen(first + (lane << (base + 4u)));
    barrier();
    for (uint level = ROLLED(6); level <= JOIN_BITS; level += 2u) {
        uint width = 1u << (JOIN_BITS - level);
        Box box = kNoBox;
        for (uint k = 0u; k < ROLLED(4); k++) box = join(box, joined[min(4u * lane + k, GROUP_SIZE - 1u)]);
        barrier();
        joined[lane] = box;
        if (lane < width) writeNode(first + (lane << (base + level)), base + level, box);
        barrier();
    }
}
