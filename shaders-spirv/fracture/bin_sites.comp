// Counting sort of the sites into the search grid, first half: each bin's sites, in any order.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, bin_start);
UPDATES(3, uint, bin_cursors);
WRITES(4, uint, loose_sites);
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low;
};
#include "lib/bin_lines.glsl"

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_SITES]) return;
    uint bin = binIndexOf(sites[s].xyz);
    loose_sites[bin_start[bin] + atomicAdd(bin_cursors[bin], 1u)] = s;
}
