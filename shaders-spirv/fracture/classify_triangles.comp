// A triangle whose three owners agree lies wholly in that convex cell and is copied, not clipped. Mixed triangles go on, and
// so do those whose corners are all tied: they may lie in a bisector, where the side of the solid decides.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, triangles);
READS(2, uint, triangle_edges);
READS(3, uint, owners);
READS(4, uint, edge_slot);
WRITES(5, uint, flags);

bool crossed(uint e) { return edge_slot[e + 1u] != edge_slot[e]; }

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_MESH_TRIANGLES] || counts[STATUS_FAILED] != 0u) return;
    bool mixed = crossed(triangle_edges[3u * t]) || crossed(triangle_edges[3u * t + 1u]) || crossed(triangle_edges[3u * t + 2u]);
    uint tied = owners[triangles[3u * t]] & owners[triangles[3u * t + 1u]] & owners[triangles[3u * t + 2u]] & 0x80000000u;
    flags[t] = mixed || tied != 0u ? 1u : 0u;
}
