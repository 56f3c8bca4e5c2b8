// A mesh edge whose ends have one owner lies in that convex cell; the others are cut.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uvec2, mesh_edges);
READS(1, uint, owners);
WRITES(2, uint, flags);
layout(push_constant) uniform Push { uint length; };

void main() {
    uint e = flatIndex();
    if (e >= length) return;
    uvec2 ends = mesh_edges[e];
    flags[e] = ((owners[ends.x] ^ owners[ends.y]) & 0x7fffffffu) != 0u ? 1u : 0u;
}
