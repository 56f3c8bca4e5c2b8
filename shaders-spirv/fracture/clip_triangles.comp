// One (triangle, cell) pair a lane: the triangle's three edges, clipped by the bisectors of the cell. A polygon is a cyclic
// list of sides (edges of the triangle or neighboring sites), a vertex is two sides in a row. Cells across a side that is a
// bisector are pairs of the next round, so that no lane ever walks all cells of a triangle.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"
#include "lib/triangle_predicate.glsl"

// Built twice: MAX_SIDES is MOST_SIDES for events in which a polygon has more sides than usual.
#ifndef MAX_SIDES
#define MAX_SIDES USUAL_SIDES
#endif
// A lane would take too many turns for a polygon of many sides. That variant has no loop over the corners of a triangle, and it copies
// sides by fours.
#if MAX_SIDES > USUAL_SIDES
#define CORNERS 3u
#define AT_ONCE 4
const uint kTurnsOfARow = 0u;
#else
#define CORNERS ROLLED(3)
#define AT_ONCE 1
const uint kTurnsOfARow = 3u;
#endif
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uvec4, cell_offsets);
READS(3, uint, neighbors);
READS(4, ivec4, grid_vertices);
READS(5, uint, triangles);
READS(6, uint, mixed_triangles);
READS(7, uint, round_bounds);
UPDATES(8, uvec2, pairs);
UPDATES(9, uint, pair_table);
WRITES(10, uint, pair_sides);
WRITES(11, uvec2, pair_shape);  // sides; the site across the bisector in which the triangle lies, solid on its side
UPDATES(12, uint, triangle_polygons);
layout(push_constant) uniform Push {
    uint pair_capacity;
    uint table_mask;
    uint side_stride; // words of pair_sides for each pair, at most MAX_SIDES
};
#include "lib/pair_set.glsl"

ivec3 corner[3];
uint side[MAX_SIDES + 2 + AT_ONCE];
uint fresh[2 * MAX_SIDES + 2 + AT_ONCE];

Row rowOf(uint i, ivec3 qi, uint id) {
    bool edge = id >= EDGE_BASE;
    ivec3 qj = sites[edge ? i : id].xyz;
    uint away = (id - EDGE_BASE + 2u) % 3u; // the barycentric coordinate that is 0 on this edge
    Row r;
    for (uint c = 0u; c < CORNERS; c++) {
        r.v[c] = edge ? (away == c ? int64_t(1) : int64_t(0)) : cornerValue(qi, qj, corner[c]);
    }
    r.id = id;
    return r;
}

// The solid lies against the normal of a triangle that faces outward: sign of normal . (q_i - q_j).
int solidSide(ivec3 qi, ivec3 qj) {
    ivec3 u = corner[1] - corner[0], w = corner[2] - corner[0], d = qi - qj;
    int64_t nx = int64_t(u.y) * int64_t(w.z) - int64_t(u.z) * int64_t(w.y);
    int64_t ny = int64_t(u.z) * int64_t(w.x) - int64_t(u.x) * int64_t(w.z);
    int64_t nz = int64_t(u.x) * int64_t(w.y) - int64_t(u.y) * int64_t(w.x);
    return wideSign(wideAdd(wideAdd(wideMul(nx, int64_t(d.x)), wideMul(ny, int64_t(d.y))), wideMul(nz, int64_t(d.z))));
}

// Turns of all loops for a cut through a polygon of `n` sides.
uint turnsToCut(uint n) { return 1u + kTurnsOfARow + (n + 1u) * (1u + kTurnsOfARow) + (n + 2u) / uint(AT_ONCE) + 1u; }

void main() {
    uint p = flatIndex() + round_bounds[0];
    if (p >= round_bounds[1] || counts[STATUS_FAILED] != 0u) return;
    uvec2 pair = pairs[p];
    uint m = pair.x, i = pair.y, t = mixed_triangles[m];
    for (uint c = 0u; c < 3u; c++) corner[c] = grid_vertices[triangles[3u * t + c]].xyz;
    ivec3 qi = sites[i].xyz;
    uint n = 3u, most = 3u, flat_with = NO_INDEX;
    bool broken = false;
    for (uint k = 0u; k < 3u; k++) side[k] = EDGE_BASE + k;

    uint next = cell_offsets[i].x, last = cell_offsets[i + 1u].x;
    uint budget = MOST_TURNS;
    for (uint turn = 0u; turn < 8192u && next < last && n > 0u && budget > 0u; turn++) {
        // Search until every lane has a bisector that may cut, then cut together.
        Row l;
        bool found = false;
        for (; next < last && !found; next++) {
            budget -= min(budget, 1u + kTurnsOfARow);
            l = rowOf(i, qi, neighbors[next]);
            found = !nearerTo(l.v[0], i, l.id) || !nearerTo(l.v[1], i, l.id) || !nearerTo(l.v[2], i, l.id);
            if (isZero(l.v[0]) && isZero(l.v[1]) && isZero(l.v[2])) flat_with = l.id;
        }
        // Corner k lies between sides k and k + 1. The corners cut away are one run; l takes the place of the sides between
        // its ends.
        uint count = found ? n : 0u, kept = 0u, exits = 0u;
        budget -= min(budget, turnsToCut(count));
        Row before = rowOf(i, qi, side[count > 0u ? n - 1u : 0u]);
        bool start_gone = false, last_gone = false;
        for (uint k = 0u; k <= count && count > 0u; k++) {
            Row here = rowOf(i, qi, side[k < count ? k : 0u]);
            bool end_gone = k < count ? triangleSign(i, before, here, l) < 0 : last_gone;
            last_gone = k == 0u ? end_gone : last_gone;
            if (k > 0u && !(start_gone && end_gone)) fresh[kept++] = side[k - 1u];
            if (k > 0u && !start_gone && end_gone) {
                fresh[kept++] = l.id;
                exits++;
            }
            start_gone = end_gone;
            before = here;
        }
        broken = broken || exits > 1u;
        most = max(most, kept);
        kept = min(kept, side_stride);
        n = found ? kept : n;
        for (uint k = 0u; k < kept; k += uint(AT_ONCE)) {
            side[k] = fresh[k];
#if AT_ONCE > 1
            side[k + 1u] = fresh[k + 1u];
            side[k + 2u] = fresh[k + 2u];
            side[k + 3u] = fresh[k + 3u];
#endif
        }
    }

    if (flat_with != NO_INDEX && solidSide(qi, sites[flat_with].xyz) <= 0) flat_with = NO_INDEX;
    // Without turns left, or stopped by lavapipe, it may have any number of sides: the event is done again with the other variant, or
    // refused.
    if (budget == 0u || (next < last && n > 0u)) most = max(most, MAX_SIDES + 1u);
    if (most > side_stride) atomicMax(counts[STATUS_SIDES], most);
    if (broken || most > side_stride) {
        if (broken) atomicAdd(counts[STATUS_BAD_CLIP], 1u);
        atomicOr(counts[STATUS_FAILED], FAILED_CLIP);
    }
    pair_shape[p] = uvec2(n, flat_with);
    if (n > 0u) atomicAdd(triangle_polygons[m], 1u);
    for (uint k = 0u; k < n; k++) {
        pair_sides[p * side_stride + k] = side[k];
        if (side[k] < EDGE_BASE) addPair(m, side[k]);
    }
}
