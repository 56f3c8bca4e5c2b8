// A mesh edge whose ends have one owner lies in that convex cell; the others are cut.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uvec2, mesh_edges);
READS(2, uint, owners);
WRITES(3, uint, flags);

void main() {
    uint e = flatIndex();
    if (e >= counts[COUNT_MESH_EDGES] || counts[STATUS_FAILED] != 0u) return;
    uvec2 ends = mesh_edges[e];
    flags[e] = ((owners[ends.x] ^ owners[ends.y]) & 0x7fffffffu) != 0u ? 1u : 0u;
}
