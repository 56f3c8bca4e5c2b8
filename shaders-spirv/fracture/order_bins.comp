// Counting sort of the sites into the search grid, second half: in each bin by id, so that nothing later depends on which
// lane came first.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, bin_start);
READS(3, uint, loose_sites);
WRITES(4, ivec4, bin_sites); // position and id
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low;
};
#include "lib/bin_lines.glsl"
#define LOOSE loose_sites
#include "lib/rank.glsl"

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_SITES]) return;
    ivec3 p = sites[s].xyz;
    uint bin = binIndexOf(p), first = bin_start[bin];
    bin_sites[first + rankIn(first, bin_start[bin + 1u], s)] = ivec4(p, int(s));
}
