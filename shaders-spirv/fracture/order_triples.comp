// Order of triple points along their Voronoi edge, exact: point 1 lies before triangle 2's plane iff sum(m1_x orient(T2; x))
// has the right sign, m1 being point 1's barycentric numerators (178 bits). Points at one place share a class; the walk
// along the edge later takes them as entering and leaving alternate.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"
#include "lib/triangle_predicate.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, ivec4, grid_vertices);
READS(3, uint, triangles);
READS(4, uvec4, triples);
READS(5, int, triple_signs);
READS(6, uint, triple_edges);
READS(7, uint, edge_triple_offsets);
READS(8, uint, loose_triples);
WRITES(9, uvec2, ordered_triples); // triple point, class

ivec3 vertexOf(uint triangle, uint c) { return grid_vertices[triangles[3u * triangle + c]].xyz; }

Wide128 orientation(ivec3 a, ivec3 b, ivec3 c, ivec3 x) {
    ivec3 u = b - a, w = c - a, d = x - a;
    int64_t nx = int64_t(u.y) * int64_t(w.z) - int64_t(u.z) * int64_t(w.y);
    int64_t ny = int64_t(u.z) * int64_t(w.x) - int64_t(u.x) * int64_t(w.z);
    int64_t nz = int64_t(u.x) * int64_t(w.y) - int64_t(u.y) * int64_t(w.x);
    return wideAdd(wideAdd(wideMul(nx, int64_t(d.x)), wideMul(ny, int64_t(d.y))), wideMul(nz, int64_t(d.z)));
}

// Where a triple point lies along its Voronoi edge, in floating point: rounded, but a number, so that any of them are in order. The
// same operations for all who ask.
real placeAlong(uint point) {
    uvec4 triple = triples[point];
    ivec3 qi = sites[triple.y].xyz, qj = sites[triple.z].xyz, qk = sites[triple.w].xyz;
    precise real3 along = cross(real3(qj - qi), real3(qk - qi)) * real(1.0 / 33554432.0), j, k, x;
    for (uint c = 0u; c < 3u; c++) {
        ivec3 p = vertexOf(triple.x, c);
        j[c] = real(cornerValue(qi, qj, p)) * real(1.0 / 33554432.0);
        k[c] = real(cornerValue(qi, qk, p)) * real(1.0 / 33554432.0);
        x[c] = dot(along, real3(p - qi));
    }
    precise real3 m = cross(j, k);
    precise real place = dot(m, x) / (m.x + m.y + m.z);
    return abs(place) < real(1e30) ? place : real(0);
}

void orderRounded(uint mine, uint first, uint last) {
    real here = placeAlong(mine);
    uint before = 0u, level = 0u;
    for (uint s = first; s < last; s++) {
        uint other = loose_triples[s];
        real there = placeAlong(other);
        before += there < here ? 1u : 0u;
        level += there == here && other < mine ? 1u : 0u;
    }
    ordered_triples[first + before + level] = uvec2(mine, before);
}

void main() {
    uint at = flatIndex();
    if (at >= counts[COUNT_TRIPLES] || counts[STATUS_FAILED] != 0u) return;
    uint mine = loose_triples[at];
    uint e = triple_edges[mine];
    if (!kExact) {
        orderRounded(mine, edge_triple_offsets[e], edge_triple_offsets[e + 1u]);
        return;
    }
    uvec4 triple = triples[mine];
    ivec3 p[3] = ivec3[3](vertexOf(triple.x, 0u), vertexOf(triple.x, 1u), vertexOf(triple.x, 2u));
    ivec3 qi = sites[triple.y].xyz, qj = sites[triple.z].xyz, qk = sites[triple.w].xyz;
    Row j, k;
    for (uint c = 0u; c < ROLLED(3); c++) {
        j.v[c] = cornerValue(qi, qj, p[c]);
        k.v[c] = cornerValue(qi, qk, p[c]);
    }
    Minors m = minorsOf(j, k);
    int sum_sign = wideSign(sumOf(m));
    uint before = 0u, level = 0u, last = edge_triple_offsets[e + 1u];
    for (uint s = edge_triple_offsets[e]; s < last; s++) {
        uint other = loose_triples[s];
        uint t = triples[other].x;
        ivec3 a = vertexOf(t, 0u), b = vertexOf(t, 1u), c = vertexOf(t, 2u);
        Wide192 side = Wide192(uint64_t(0), uint64_t(0), int64_t(0));
        for (uint x = 0u; x < ROLLED(3); x++) side = wideAdd(side, wideMul192(m.m[x], orientation(a, b, c, p[x])));
        int place = wideSign(side) * sum_sign * triple_signs[other]; // > 0: mine lies after the other
        before += place > 0 ? 1u : 0u;
        level += place == 0 && other < mine ? 1u : 0u;
    }
    ordered_triples[edge_triple_offsets[e] + before + level] = uvec2(mine, before);
}
