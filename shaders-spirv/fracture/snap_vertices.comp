// Mesh vertices to the event's 24-bit grid, or, of several objects (TILED), each to its own. The scale is a power of two, so nothing is rounded but the last step, and every
// device snaps alike. The grid decides topology only; vertices are emitted with their own coordinates.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/tile.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, float, mesh_positions);
WRITES(2, ivec4, grid_vertices);
#ifdef TILED
READS(3, uint, vertex_tiles); // numbers
#endif
layout(push_constant) uniform Push { float scale; }; // grid steps per model unit

void main() {
    uint v = flatIndex();
    if (v >= counts[COUNT_MESH_VERTICES]) return;
    precise vec3 p = vec3(mesh_positions[3u * v], mesh_positions[3u * v + 1u], mesh_positions[3u * v + 2u]) * scale;
    ivec3 corner = ivec3(0);
#ifdef TILED
    corner = tileAt(vertex_tiles[v]);
#endif
    grid_vertices[v] = ivec4(corner + ivec3(roundEven(p)) + ivec3(1 << 23), 0);
}
