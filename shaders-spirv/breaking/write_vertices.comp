// Vertices of all that breaks, by number, and on the grid of their object in its tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/half_edge.glsl"
#include "lib/tile.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, corners);
READS(2, uint, vertex_numbers); // of the corners that are the first at their place
WRITES(3, float, mesh_positions);
WRITES(4, ivec4, grid_vertices);
WRITES(5, uint, args);
layout(push_constant) uniform Push { uint triangle_room; };
#include "lib/publish.glsl"

// Of both kinds of triangles, and their corners.
void publishTriangles() {
    uint triangles = counts[COUNT_OWN_TRIANGLES] + counts[COUNT_EARLIER_TRIANGLES];
    publishCount(COUNT_MESH_TRIANGLES, triangles, triangle_room);
    publishCount(COUNT_MESH_CORNERS, 3u * triangles, 3u * triangle_room);
}

void main() {
    uint c = flatIndex();
    if (c == 0u) publishTriangles();
    if (c >= counts[COUNT_SOUP_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    uint v = vertex_numbers[c];
    if (vertex_numbers[c + 1u] == v) return;
    vec3 p = uintBitsToFloat(uvec3(corners[4u * c], corners[4u * c + 1u], corners[4u * c + 2u]));
    for (uint k = 0u; k < 3u; k++) mesh_positions[3u * v + k] = p[k];
    grid_vertices[v] = ivec4(tileAt(corners[4u * c + 3u]) + onGrid(p), 0);
}
