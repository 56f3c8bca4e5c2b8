// Triangles of all that breaks: the surfaces of all objects, then all faces of earlier cuts. Their corners' normals and texture
// coordinates go with them, and the ends of their sides, the lower vertex first. Runs once for each part of the list of surfaces.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/scene.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, SceneVertex, vertices); // of one part of the list of surfaces
READS(3, uint, firsts);
READS(4, uint, vertex_numbers);
READS(5, uvec4, triangle_numbers); // own, of earlier cuts
WRITES(6, uint, mesh_triangles);
WRITES(7, float, corner_attributes); // five a corner: normal, texture coordinates
WRITES(8, uint, sides);              // two words each
layout(push_constant) uniform Push { uint first_vertex, end_vertex; }; // of the part
#include "lib/breaking_corner.glsl"

void writeAttributes(uint corner, uint v) {
    for (uint k = 0u; k < 3u; k++) corner_attributes[5u * corner + k] = vertices[v].normal[k];
    for (uint k = 0u; k < 2u; k++) corner_attributes[5u * corner + 3u + k] = vertices[v].uv[k];
}

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_SOUP_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 here = triangle_numbers[t], after = triangle_numbers[t + 1u];
    if (here.xy == after.xy) return;
    uint at = here.x != after.x ? here.x : counts[COUNT_OWN_TRIANGLES] + here.y;
    BreakingRecord object = breaking[objectOf(3u * t)];
    uint first = vertexOf(object, 3u * t);
    if (first < first_vertex || first >= end_vertex) return;
    uint v[3];
    for (uint k = 0u; k < 3u; k++) {
        v[k] = vertex_numbers[firsts[3u * t + k]];
        mesh_triangles[3u * at + k] = v[k];
        writeAttributes(3u * at + k, first + k - first_vertex);
    }
    for (uint k = 0u; k < 3u; k++) {
        uint from = v[k], to = v[(k + 1u) % 3u];
        sides[2u * (3u * at + k)] = min(from, to);
        sides[2u * (3u * at + k) + 1u] = max(from, to);
    }
}
