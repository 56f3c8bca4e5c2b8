// Gathers the triple points by Voronoi edge; order_triples puts them in place.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, uint, triple_edges);
READS(2, uint, edge_triple_offsets);
UPDATES(3, uint, cursors);
WRITES(4, uint, loose_triples);

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TRIPLES] || counts[STATUS_FAILED] != 0u) return;
    uint e = triple_edges[k];
    if (e != NO_INDEX) loose_triples[edge_triple_offsets[e] + atomicAdd(cursors[e], 1u)] = k;
}
