// Puts the polygons of each triangle in the order of their cells, and counts what each brings: sides, triple points that it
// writes (it is the lowest of their three cells), cut segments that it writes, and triangles.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec2, pairs);
READS(2, uvec2, pair_shape);
READS(3, uint, pair_sides);
READS(4, uint, polygon_offsets);
READS(5, uint, loose_polygons);
READS(6, uint, mixed_triangles);
WRITES(7, uvec4, polygons); // triangle, cell, flat with, pair
WRITES(8, uvec4, polygon_counts);
layout(push_constant) uniform Push { uint side_stride; };

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uint p = loose_polygons[at];
    uvec2 pair = pairs[p], shape = pair_shape[p];
    uint rank = polygon_offsets[pair.x], last = polygon_offsets[pair.x + 1u];
    if (last - rank > MOST_TURNS) {
        atomicAdd(counts[STATUS_TOO_LONG], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
        last = rank;
    }
    for (uint k = polygon_offsets[pair.x]; k < last; k++) rank += pairs[loose_polygons[k]].y < pair.y ? 1u : 0u;
    uvec4 sum = uvec4(shape.x, 0u, shape.y != NO_INDEX ? shape.x : 0u, shape.x - 2u);
    uint side = pair_sides[p * side_stride + shape.x - 1u];
    for (uint k = 0u; k < shape.x; k++) {
        uint next = pair_sides[p * side_stride + k];
        bool cut = next < EDGE_BASE && next > pair.y;
        sum.z += cut ? 1u : 0u;
        sum.y += cut && side < EDGE_BASE && side > pair.y ? 1u : 0u;
        side = next;
    }
    polygons[rank] = uvec4(mixed_triangles[pair.x], pair.y, shape.y, p);
    polygon_counts[rank] = sum;
}
