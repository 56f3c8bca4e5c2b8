// The first pairs of every mixed triangle: the cells that its three edges pass through.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, mixed_triangles);
READS(2, uint, triangles);
READS(3, uint, triangle_edges);
READS(4, uint, owners);
READS(5, uint, edge_slot);
READS(6, uint, crossing_offsets);
READS(7, uvec4, crossings);
UPDATES(8, uvec2, pairs);
UPDATES(9, uint, pair_table);
layout(push_constant) uniform Push {
    uint pair_capacity;
    uint table_mask;
};
#include "lib/pair_set.glsl"

void main() {
    uint m = flatIndex();
    if (m >= counts[COUNT_MIXED_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uint t = mixed_triangles[m];
    for (uint k = 0u; k < 3u; k++) {
        addPair(m, owners[triangles[3u * t + k]] & 0x7fffffffu);
        uint e = triangle_edges[3u * t + k], slot = edge_slot[e];
        bool crossed = edge_slot[e + 1u] != slot;
        uint first = crossed ? crossing_offsets[slot] : 0u, last = crossed ? crossing_offsets[slot + 1u] : 0u;
        for (uint c = first; c < last; c++) addPair(m, crossings[c].y);
    }
}
