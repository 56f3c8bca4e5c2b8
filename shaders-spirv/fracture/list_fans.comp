// Clipped polygons as fans.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, polygons);
READS(2, uvec4, polygon_offsets);
READS(3, uint, polygon_corners);
READS(4, uint, welded);
WRITES(5, uvec4, pieces);
WRITES(6, uint, sources);
WRITES(7, uint, parents);

void main() {
    uint q = flatIndex();
    if (q >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 polygon = polygons[q], at = polygon_offsets[q];
    uint n = polygon_offsets[q + 1u].x - at.x;
    uint cell = polygon.z != NO_INDEX ? polygon.z : polygon.y;
    uint a = welded[polygon_corners[at.x]], b = welded[polygon_corners[at.x + 1u]];
    for (uint k = 2u; k < n; k++) {
        uint c = welded[polygon_corners[at.x + k]], to = counts[COUNT_MESH_TRIANGLES] + at.w + k - 2u;
        bool flat_ = a == b || b == c || c == a;
        pieces[to] = uvec4(a, b, c, flat_ ? NO_INDEX : cell);
        sources[to] = polygon.x;
        parents[to] = to;
        b = c;
    }
}
