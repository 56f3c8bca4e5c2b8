// Names the corners of the polygons: mesh vertex | crossing on a mesh edge | triple point. Every polygon that meets at a
// corner finds the same name by a search in the edge's or triangle's own range.
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

uint tripleAt(uint triangle, uvec3 s) {
    uint q = findPolygon(triangle, s.x), found = NO_INDEX;
    uint first = q != NO_INDEX ? polygon_offsets[q].y : 0u, last = q != NO_INDEX ? polygon_offsets[q + 1u].y : 0u;
    for (uint k = first; k < last; k++) {
        if (triples[k].yzw == s) found = k;
    }
    return found == NO_INDEX ? NO_INDEX : counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS] + found;
}

// Which of the triangle's edges its polygon has a side on.
uint edgesOf(uint first, uint n) {
    uint edges = 0u;
    for (uint k = 0u; k < n; k++) edges |= sides[first + k] >= EDGE_BASE ? 1u << (sides[first + k] - EDGE_BASE) : 0u;
    return edges;
}

// The corner between an edge and the side across which `other` lies; n if there is none.
uint cornerBetween(uint first, uint n, uint edge, uint other) {
    uint found = n;
    for (uint k = 0u; k < n; k++) {
        uvec2 pair = uvec2(sides[first + k], sides[first + (k + 1u < n ? k + 1u : 0u)]);
        if (pair == uvec2(EDGE_BASE + edge, other) || pair == uvec2(other, EDGE_BASE + edge)) found = k;
    }
    return found;
}

// Corners on an edge. Its crossings, which may be thousands, are walked through once: the cell is in two of them at most. Returns how
// many corners have got their names.
uint nameCrossings(uint t, uint edge, uint cell, uint first, uint n) {
    uint e = triangle_edges[3u * t + edge], slot = edge_slot[e], named = 0u;
    bool crossed = edge_slot[e + 1u] != slot;
    uint begin = crossed ? crossing_offsets[slot] : 0u, end = crossed ? crossing_offsets[slot + 1u] : 0u;
    for (uint c = begin; c < end; c++) {
        uvec2 pass = crossings[c].xy;
        if (pass.x != cell && pass.y != cell) continue;
        uint k = cornerBetween(first, n, edge, pass.x == cell ? pass.y : pass.x);
        if (k == n) continue;
        polygon_corners[first + k] = counts[COUNT_MESH_VERTICES] + c;
        named++;
    }
    return named;
}

void main() {
    uint q = flatIndex();
    if (q >= counts[COUNT_POLYGONS] || counts[STATUS_FAILED] != 0u) return;
    uvec4 polygon = polygons[q];
    uint first = polygon_offsets[q].x, n = polygon_offsets[q + 1u].x - first, t = polygon.x;
    uint edges = edgesOf(first, n), on_edges = 0u, named = 0u;
    bool lost = false;
    for (uint k = 0u; k < n; k++) {
        uint x = sides[first + k], y = sides[first + (k + 1u < n ? k + 1u : 0u)];
        bool ex = x >= EDGE_BASE, ey = y >= EDGE_BASE;
        uint kx = x - EDGE_BASE, ky = y - EDGE_BASE;
        uint corner = (kx + 1u) % 3u == ky ? ky : kx;
        bool is_crossing = ex != ey;
        uint id = ex && ey ? triangles[3u * t + corner] : is_crossing ? 0u : tripleAt(t, sorted3(uvec3(polygon.y, x, y)));
        on_edges += is_crossing ? 1u : 0u;
        lost = lost || id == NO_INDEX;
        polygon_corners[first + k] = id == NO_INDEX ? 0u : id;
    }
    for (uint edge = 0u; edge < ROLLED(3); edge++) {
        if ((edges & (1u << edge)) != 0u) named += nameCrossings(t, edge, polygon.y, first, n);
    }
    if (lost || named != on_edges) {
        atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    }
}
