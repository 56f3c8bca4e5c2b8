// Sides of the mesh's triangles by the places of their ends on the grid, the lower first: vertices of one place are one. A triangle
// with two corners at one place has no area, and no side that another has.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, triangles);
READS(2, uint, first_vertices); // of those at one place, the first
WRITES(3, uvec2, sides);

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_MESH_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uint at[3];
    for (uint k = 0u; k < 3u; k++) at[k] = first_vertices[triangles[3u * t + k]];
    bool is_flat = at[0] == at[1] || at[1] == at[2] || at[2] == at[0];
    for (uint k = 0u; k < 3u; k++) {
        uint from = at[k], to = at[(k + 1u) % 3u];
        sides[3u * t + k] = is_flat ? uvec2(3u * t + k, NO_INDEX) : uvec2(min(from, to), max(from, to));
    }
}
