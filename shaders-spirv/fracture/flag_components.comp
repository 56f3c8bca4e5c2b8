// Triangles that stay, and among them the lowest of each component.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec4, pieces);
UPDATES(2, uint, parents);
WRITES(3, uvec4, flags);
#include "lib/union_find.glsl"

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    bool valid = pieces[t].w != NO_INDEX;
    flags[t] = uvec4(valid ? 1u : 0u, valid && rootOf(t) == t ? 1u : 0u, 0u, 0u);
}
