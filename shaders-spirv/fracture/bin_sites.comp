// Counting sort of the sites into the search grid.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, bin_start);
UPDATES(3, uint, bin_cursors);
WRITES(4, ivec4, bin_sites);
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low;
};

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_SITES]) return;
    ivec3 p = sites[s].xyz;
    ivec3 b = min((p - box_low.xyz) / bins.w, bins.xyz - 1);
    uint bin = uint((b.z * bins.y + b.y) * bins.x + b.x);
    // In the order of ids, so that nothing later depends on who came first.
    uint rank = 0u;
    for (uint k = 0u; k < s; k++) {
        ivec3 o = min((sites[k].xyz - box_low.xyz) / bins.w, bins.xyz - 1);
        rank += o == b ? 1u : 0u;
    }
    bin_sites[bin_start[bin] + rank] = ivec4(p, int(s));
}
