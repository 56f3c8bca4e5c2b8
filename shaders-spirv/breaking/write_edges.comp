// Edges of all that breaks, by number, and the edge of each side of each triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, sides);
READS(2, uint, firsts);
READS(3, uint, edge_numbers); // of the sides that are the first of their edge
WRITES(4, uint, triangle_edges);
WRITES(5, uvec2, mesh_edges);

void main() {
    uint s = flatIndex();
    if (s >= counts[COUNT_MESH_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    uint first = firsts[s], edge = edge_numbers[first];
    triangle_edges[s] = edge;
    if (first == s) mesh_edges[edge] = uvec2(sides[2u * s], sides[2u * s + 1u]);
}
