// Triangles that are left where corners have become one: a collapsed one bounds nothing. Those of the surface and those of
// earlier cuts are counted apart.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "shared/breaking.h"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, uint, firsts);
WRITES(3, uvec4, flags);
#include "lib/breaking_corner.glsl"

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_SOUP_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    uint a = firsts[3u * t], b = firsts[3u * t + 1u], c = firsts[3u * t + 2u];
    bool solid = a != b && b != c && c != a, earlier = isOfEarlierCut(breaking[objectOf(3u * t)], 3u * t);
    flags[t] = uvec4(solid && !earlier ? 1u : 0u, solid && earlier ? 1u : 0u, 0u, 0u);
}
