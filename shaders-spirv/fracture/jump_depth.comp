// Pointer jumping: each vertex follows the links of the last round, up to eight at a time.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec2, links);
WRITES(2, uvec2, next_links);
layout(push_constant) uniform Push { uint is_last; };

void main() {
    uint v = flatIndex();
    if (v >= counts[COUNT_VORONOI_VERTICES] || counts[STATUS_FAILED] != 0u) return;
    uvec2 link = links[v];
    for (uint k = 0u; k < 7u && link.x != NO_INDEX; k++) {
        uvec2 further = links[link.x];
        link = uvec2(further.x, link.y + further.y);
    }
    if (is_last != 0u && link.x != NO_INDEX) atomicAdd(counts[STATUS_BAD_DEPTH], 1u);
    next_links[v] = link;
}
