// The first of those that are the same, for each, and a flag for those that are the first: of corners at a place, of sides of an edge.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, table);
READS(2, uint, slots);
WRITES(3, uint, firsts);
WRITES(4, uint, flags);
layout(push_constant) uniform Push { uint length_count; };

void main() {
    uint k = flatIndex();
    if (k >= counts[length_count] || counts[STATUS_FAILED] != 0u) return;
    uint first = table[slots[k]] - 1u;
    firsts[k] = first;
    flags[k] = first == k ? 1u : 0u;
}
