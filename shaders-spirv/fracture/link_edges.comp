// Gives every Voronoi edge its sites, and the vertices at its two ends (NO_INDEX where it leaves the box). A lane an edge: a
// lane a corner would look for three, of which half of one is there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"
#include "lib/precision.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, cell_offsets);
READS(2, uvec4, corners);
READS(3, uvec2, corner_info);
WRITES(4, uvec4, edge_sites);
UPDATES(5, uvec2, edge_ends); // as gather_cells leaves them

// The corner of the edge's own cell at which it begins: the one that holds (y, x) in this order.
uint beginOf(uvec3 edge) {
    uint begin = NO_INDEX, last = cell_offsets[edge.x + 1u].y;
    for (uint t = cell_offsets[edge.x].y; t < last; t++) {
        uvec3 c = corners[t].xyz;
        bool found = (c.x == edge.z && c.y == edge.y) || (c.y == edge.z && c.z == edge.y) || (c.z == edge.z && c.x == edge.y);
        begin = found ? t : begin;
    }
    return begin;
}

// Numbered in the edge's own cell, unless the fourth cell at the vertex is lower: then it is found there.
uint vertexAt(uvec3 edge, uvec4 corner) {
    uint fourth = corner.x ^ corner.y ^ corner.z ^ edge.y ^ edge.z;
    bool foreign = fourth < edge.x;
    uint vertex = corner.w;
    uint last = foreign ? cell_offsets[fourth + 1u].y : 0u;
    for (uint t = foreign ? cell_offsets[fourth].y : 0u; t < last; t++) {
        uvec4 c = corners[t];
        vertex = sorted3(c.xyz) == edge ? c.w : vertex;
    }
    return vertex;
}

void main() {
    uint e = flatIndex();
    if (e >= counts[COUNT_VORONOI_EDGES] || counts[STATUS_FAILED] != 0u) return;
    uvec2 named = edge_ends[e];
    uvec4 end = corners[named.x];
    uvec3 edge = uvec3(corner_info[named.x].x, end[named.y], end[(named.y + 1u) % 3u]);
    uint begin = beginOf(edge);
    if (!kExact && begin == NO_INDEX) { // the cell is not closed
        atomicAdd(counts[STATUS_BAD_DIAGRAM], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CELLS);
        begin = named.x;
    }
    edge_sites[e] = uvec4(edge, 0u);
    edge_ends[e] = uvec2(vertexAt(edge, corners[begin]), vertexAt(edge, end));
}
