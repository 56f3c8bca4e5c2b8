// Triangles that lie in one cell, as they are. A triangle with two corners at one place has no area and is dropped; its
// neighbors then meet.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, triangles);
READS(2, uint, owners);
READS(3, uint, triangle_slot);
READS(4, uint, welded);
WRITES(5, uvec4, pieces); // three corners, cell or NO_INDEX
WRITES(6, uint, sources);
WRITES(7, uint, parents);

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_MESH_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    bool mixed = triangle_slot[t + 1u] != triangle_slot[t];
    uint a = triangles[3u * t], b = triangles[3u * t + 1u], c = triangles[3u * t + 2u];
    uint cell = owners[a] & 0x7fffffffu;
    a = welded[a];
    b = welded[b];
    c = welded[c];
    bool flat_ = a == b || b == c || c == a;
    pieces[t] = uvec4(a, b, c, mixed || flat_ ? NO_INDEX : cell);
    sources[t] = t;
    parents[t] = t;
}
