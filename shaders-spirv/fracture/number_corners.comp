// Names the corners of the polygons: mesh vertex | crossing on a mesh edge | triple point. Every polygon that meets at a
// corner finds the same name by a search in the edge's or triangle's own short range.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, polygons);
READS(2, uvec4, polygon_offsets);
READS(3, uint, sides);
READS(4, uint, triangles);
READS(5, uint, triangle_edges);
READS(6, uint, edge_slot);
READS(7, uint, crossing_offsets);
READS(8, uvec4, crossings);
READS(9, uint, triangle_slot);
READS(10, uint, triangle_polygon_offsets);
READS(11, uvec4, triples);
WRITES(12, uint, polygon_corners); // corner k lies between sides k and k + 1
#include "lib/find_polygon.glsl"

uint crossingOn(uint edge, uint cell, uint other) {
    uint slot = edge_slot[edge], found = NO_INDEX;
    bool crossed = edge_slot[edge + 1u] != slot;
    uint first = crossed ? crossing_offsets[slot] : 0u, last = crossed ? crossing_offsets[slot + 1u] : 0u;
    for (uint c = first; c < last; c++) {
        uvec2 pass = crossings[c].xy;
        if (pass == uvec2(cell, other) || pass == uvec2(other, cell)) found = c;
    }
    return found == NO_INDEX ? NO_INDEX : counts[COUNT_MESH_VERTICES] + found;
}

uint tripleAt(uint triangle, uvec3 s) {
    uint q = findPolygon(triangle, s.x), found = NO_INDEX;
    uint first = q != NO_INDEX ? polygon_offsets[q].y : 0u, last = q != NO_INDEX ? polygon_offsets[q + 1u].y : 0u;
    for (uint k = first; k < last; k++) {
        if (triples[k].yzw == s) found = k;
    }
    return found == NO_INDEX ? NO_INDEX : counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS] + found;
}

void main() {
    uint q = flatIndex();
    if (q >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 polygon = polygons[q];
    uint first = polygon_offsets[q].x, n = polygon_offsets[q + 1u].x - first, t = polygon.x;
    bool lost = false;
    for (uint k = 0u; k < n; k++) {
        uint x = sides[first + k], y = sides[first + (k + 1u < n ? k + 1u : 0u)];
        bool ex = x >= EDGE_BASE, ey = y >= EDGE_BASE;
        uint kx = x - EDGE_BASE, ky = y - EDGE_BASE;
        uint edge = ex ? kx : (ey ? ky : 0u);
        uint corner = (kx + 1u) % 3u == ky ? ky : kx;
        uint id = triangles[3u * t + (ex && ey ? corner : 0u)];
        uint on_edge = crossingOn(triangle_edges[3u * t + edge], polygon.y, ex ? y : x);
        uint inside = tripleAt(t, sorted3(uvec3(polygon.y, x, y)));
        id = ex && ey ? id : (ex || ey ? on_edge : inside);
        lost = lost || id == NO_INDEX;
        polygon_corners[first + k] = id == NO_INDEX ? 0u : id;
    }
    if (lost) {
        atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    }
}
