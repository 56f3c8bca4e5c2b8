// Where a mesh edge passes from cell to cell, from its low end to its high one: in each cell the bisector that is left
// through first, by the exact edge predicate. Runs twice, to count and to fill.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"
#include "lib/edge_predicate.glsl"

layout(constant_id = 0) const uint kFill = 0u;
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uvec4, cell_offsets);
READS(3, uint, neighbors);
READS(4, ivec4, grid_vertices);
READS(5, uvec2, mesh_edges);
READS(6, uint, owners);
READS(7, uint, mixed_edges);
UPDATES(8, uint, crossing_counts);
READS(9, uint, crossing_offsets);
WRITES(10, uvec4, crossings); // from site, to site, mesh edge

void main() {
    uint m = flatIndex();
    if (m >= counts[COUNT_MIXED_EDGES] || counts[STATUS_FAILED] != 0u) return;
    uint e = mixed_edges[m];
    uvec2 ends = mesh_edges[e];
    ivec3 a = grid_vertices[ends.x].xyz, b = grid_vertices[ends.y].xyz;
    uint at = owners[ends.x] & 0x7fffffffu, goal = owners[ends.y] & 0x7fffffffu, n = 0u;
    uint base = kFill != 0u ? crossing_offsets[m] : 0u;
    // One loop, in which every lane looks at one neighbor or goes on to the next cell: so its turns are those of the lane that has the
    // most to do. With a loop in a loop lavapipe would count the longest inner one of every turn.
    uint k = cell_offsets[at].x, last = cell_offsets[at + 1u].x, best = NO_INDEX, turn = 0u;
    int64_t ja = int64_t(0), jb = int64_t(0);
    ivec3 q = sites[at].xyz;
    bool lost = false;
    for (; turn < MOST_TURNS && at != goal && !lost; turn++) {
        if (k < last) {
            uint j = neighbors[k];
            ivec3 qj = sites[j].xyz;
            int64_t la = cornerValue(q, qj, a), lb = cornerValue(q, qj, b);
            bool earlier = best == NO_INDEX || edgeSign(at, best, j, ja, jb, la, lb) < 0;
            if (!nearerTo(lb, at, j) && earlier) {
                best = j;
                ja = la;
                jb = lb;
            }
            k++;
        } else if (best == NO_INDEX) {
            lost = true;
        } else {
            if (kFill != 0u) crossings[base + n] = uvec4(at, best, e, 0u);
            n++;
            at = best;
            q = sites[at].xyz;
            k = cell_offsets[at].x;
            last = cell_offsets[at + 1u].x;
            best = NO_INDEX;
        }
    }
    if (turn == MOST_TURNS || n > MOST_CELLS_OF_AN_EDGE) {
        atomicAdd(counts[STATUS_TOO_LONG], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    } else if (at != goal) {
        atomicAdd(counts[STATUS_BAD_LOOKUP], 1u);
    }
    if (kFill == 0u) crossing_counts[m] = n;
}
