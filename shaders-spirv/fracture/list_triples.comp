// Copies the sides in polygon order, and writes the triple points (triangle; i < j < k) from their lowest cell. The sign
// says how the surface passes the Voronoi edge: sides (j, k) in a row with j < k leave the solid along the edge's direction.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, polygons);
READS(2, uvec4, polygon_offsets);
READS(3, uint, pair_sides);
WRITES(4, uint, sides);
WRITES(5, uvec4, triples);    // triangle, three sites in order
WRITES(6, int, triple_signs);
layout(push_constant) uniform Push { uint side_stride; };

void main() {
    uint q = flatIndex();
    if (q >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 polygon = polygons[q], at = polygon_offsets[q];
    uint n = polygon_offsets[q + 1u].x - at.x;
    for (uint k = 0u; k < n; k++) {
        uint x = pair_sides[polygon.w * side_stride + k];
        uint y = pair_sides[polygon.w * side_stride + (k + 1u < n ? k + 1u : 0u)];
        sides[at.x + k] = x;
        if (x < EDGE_BASE && y < EDGE_BASE && x > polygon.y && y > polygon.y) {
            triples[at.y] = uvec4(polygon.x, polygon.y, min(x, y), max(x, y));
            triple_signs[at.y] = x < y ? 1 : -1;
            at.y++;
        }
    }
}
