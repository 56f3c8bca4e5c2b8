// The sites of the event, by id, and how many lie in each bin of the search grid.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, site_slot);
READS(2, uint, raw_sites);
WRITES(3, ivec4, sites); // position on the grid; w: which of the sites asked for
UPDATES(4, uint, bin_counts);
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low;
};
#include "lib/bin_lines.glsl"

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_ASKED_SITES] || counts[STATUS_FAILED] != 0u) return;
    uint at = site_slot[s];
    if (site_slot[s + 1u] == at) return;
    ivec3 p = ivec3(int(raw_sites[3u * s]), int(raw_sites[3u * s + 1u]), int(raw_sites[3u * s + 2u]));
    sites[at] = ivec4(p, int(s));
    atomicAdd(bin_counts[binIndexOf(p)], 1u);
}
