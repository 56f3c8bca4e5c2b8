// Corners of all that breaks: where each lies, from its object's center in units of half a grid's edge, and its object. The unit is
// a power of two, so that nothing is rounded but the way to the center. Runs once for each part of the list of surfaces.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"
#include "shared/scene.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, SceneVertex, vertices); // of one part of the list of surfaces
WRITES(3, uint, corners);        // four words: place as bits, object
layout(push_constant) uniform Push { uint first_vertex, end_vertex; }; // of the part
#include "lib/breaking_corner.glsl"

void main() {
    uint c = flatIndex();
    if (c >= counts[COUNT_SOUP_CORNERS] || counts[STATUS_FAILED] != 0u) return;
    uint object = objectOf(c);
    BreakingRecord r = breaking[object];
    uint v = vertexOf(r, c);
    if (v < first_vertex || v >= end_vertex) return;
    for (uint k = 0u; k < 3u; k++) {
        precise float way = (vertices[v - first_vertex].position[k] - r.center[k]) * r.center.w;
        corners[4u * c + k] = floatBitsToUint(way == 0.0 ? 0.0 : way);
    }
    corners[4u * c + 3u] = object;
}
