// Gives every Voronoi edge its three sites and the vertices at its two ends (NO_INDEX where it leaves the box).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, cell_offsets);
READS(2, uvec4, corners);
READS(3, uvec2, corner_info);
WRITES(4, uvec4, edge_sites);
WRITES(5, uvec2, edge_ends);
#include "lib/find_voronoi.glsl"

// The third site of the corner of `cell` that holds (y, x) in this order.
uint thirdBefore(uint cell, uint x, uint y) {
    uint third = NO_INDEX;
    uint last = cell_offsets[cell + 1u].y;
    for (uint t = cell_offsets[cell].y; t < last; t++) {
        uvec3 c = corners[t].xyz;
        if (c.x == y && c.y == x) third = c.z;
        if (c.y == y && c.z == x) third = c.x;
        if (c.z == y && c.x == x) third = c.y;
    }
    return third;
}

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_CORNERS]) return;
    uvec3 c = corners[t].xyz;
    uvec2 info = corner_info[t];
    uint cell = info.x, at = info.y;
    for (uint k = 0u; k < 3u; k++) {
        uint x = c[k], y = c[(k + 1u) % 3u];
        if (ownsEdge(cell, x, y)) {
            uint third = thirdBefore(cell, x, y);
            edge_sites[at] = uvec4(cell, x, y, 0u);
            edge_ends[at] = uvec2(findVoronoiVertex(sorted4(cell, uvec3(x, y, third))), findVoronoiVertex(sorted4(cell, c)));
            at++;
        }
    }
}
