// The Voronoi edge that each triple point lies on, and how the surface's passages add up along it.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, cell_offsets);
READS(2, uvec4, corners);
READS(3, uvec2, corner_info);
READS(4, uvec4, triples);
READS(5, int, triple_signs);
WRITES(6, uint, triple_edges);
UPDATES(7, uint, edge_triple_counts);
UPDATES(8, int, edge_sums);
#include "lib/find_voronoi.glsl"

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TRIPLES] || counts[STATUS_FAILED] != 0u) return;
    uvec3 s = triples[k].yzw;
    uint e = findVoronoiEdge(s.x, s.y, s.z);
    triple_edges[k] = e;
    if (e == NO_INDEX) {
        atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    } else {
        atomicAdd(edge_triple_counts[e], 1u);
        atomicAdd(edge_sums[e], triple_signs[k]);
    }
}
