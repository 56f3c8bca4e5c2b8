// The site that owns each mesh vertex: from a site in or near the vertex's bin, step to the neighbor that is nearer (of
// equal ones the lower id) until none is. In one perturbed diagram this descent cannot stop early or go round.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uint, bin_start);
READS(3, ivec4, bin_sites);
READS(4, uvec4, cell_offsets);
READS(5, uint, neighbors);
READS(6, ivec4, grid_vertices);
WRITES(7, uint, owners); // top bit: some other site is exactly as near
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low;
};
#include "lib/bin_lines.glsl"

void main() {
    uint v = flatIndex();
    if (v >= counts[COUNT_MESH_VERTICES] || counts[STATUS_FAILED] != 0u) return;
    ivec3 p = grid_vertices[v].xyz;
    uint at = bin_start[binIndex(max(binOf(p), ivec3(0)), p)], end = bin_start[binIndex(bins.xyz - 1, p) + 1u];
    uint own = uint(bin_sites[min(at, max(end, 1u) - 1u)].w); // the last of its tile where no bin further on has any
    bool moved = true, tied = false;
    uint budget = MOST_TURNS;
    for (uint step = 0u; step < 8192u && moved && budget > 0u; step++) {
        ivec3 qo = sites[own].xyz, qb = qo;
        uint best = own, last = cell_offsets[own + 1u].x;
        tied = false;
        for (uint k = cell_offsets[own].x; k < last; k++) {
            uint j = neighbors[k];
            ivec3 qj = sites[j].xyz;
            tied = tied || isZero(cornerValue(qo, qj, p));
            if (!nearerTo(cornerValue(qb, qj, p), best, j)) {
                best = j;
                qb = qj;
            }
            budget -= min(budget, 1u);
        }
        moved = best != own;
        own = best;
    }
    if (moved) atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
    owners[v] = own | (tied ? 0x80000000u : 0u);
}
