// Classifies Voronoi vertices as inside or outside by winding depth. Depth is 0 outside the box and changes by one where a
// Voronoi edge passes the surface. Every vertex points along one of its four edges, the one that leads up in (x, y, z)
// order: directions of edges do not depend on the perturbation, positions do not matter, and no cycle is possible.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/diagram.glsl"
#include "lib/wide.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uvec4, cell_offsets);
READS(3, uvec4, corners);
READS(4, uvec2, corner_info);
READS(5, uvec4, vertex_sites);
READS(6, uvec2, edge_ends);
READS(7, int, edge_sums);
WRITES(8, uvec2, links); // vertex further up, depth relative to it
#include "lib/find_voronoi.glsl"

int upward(uvec3 s) {
    ivec3 a = sites[s.x].xyz, u = sites[s.y].xyz - a, w = sites[s.z].xyz - a;
    int64_t x = int64_t(u.y) * int64_t(w.z) - int64_t(u.z) * int64_t(w.y);
    int64_t y = int64_t(u.z) * int64_t(w.x) - int64_t(u.x) * int64_t(w.z);
    int64_t z = int64_t(u.x) * int64_t(w.y) - int64_t(u.y) * int64_t(w.x);
    int64_t first = !isZero(x) ? x : (!isZero(y) ? y : z);
    return signOf(first) > 0 ? 1 : (isNegative(first) ? -1 : 0);
}

void main() {
    uint v = flatIndex();
    if (v >= counts[COUNT_VORONOI_VERTICES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 s = vertex_sites[v];
    bool found = false;
    uvec2 link = uvec2(NO_INDEX, 0u);
    for (uint k = 0u; k < 4u; k++) {
        uvec3 three = k == 0u ? s.yzw : (k == 1u ? s.xzw : (k == 2u ? s.xyw : s.xyz));
        uint e = findVoronoiEdge(three.x, three.y, three.z);
        bool known = e != NO_INDEX;
        uvec2 ends = edge_ends[known ? e : 0u];
        int direction = upward(three);
        bool at_start = ends.x == v;
        bool leads = known && !found && direction != 0 && (at_start ? direction > 0 : direction < 0);
        if (leads) {
            int sum = edge_sums[e];
            link = at_start ? uvec2(ends.y, uint(sum)) : uvec2(ends.x, uint(-sum));
            found = true;
        }
    }
    if (!found) atomicAdd(counts[STATUS_BAD_DEPTH], 1u);
    links[v] = link;
}
