// Points where a triangle meets three cells, from exact barycentric numerators. One that lies on an edge of the triangle is
// placed as a point of that edge, by the edge's own rule, so that it coincides with crossings there.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"
#include "lib/triangle_predicate.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, ivec4, grid_vertices);
READS(3, float, mesh_positions);
READS(4, uint, triangles);
READS(5, uvec4, triples);
WRITES(6, uint, points);
WRITES(7, vec4, positions);
#include "lib/place.glsl"

vec3 modelVertex(uint v) { return vec3(mesh_positions[3u * v], mesh_positions[3u * v + 1u], mesh_positions[3u * v + 2u]); }

Wide128 magnitude(Wide128 a) { return isNegative(a.hi) ? wideNegate(a) : a; }

void main() {
    uint k = flatIndex();
    if (k >= counts[COUNT_TRIPLES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 triple = triples[k];
    uvec3 v = uvec3(triangles[3u * triple.x], triangles[3u * triple.x + 1u], triangles[3u * triple.x + 2u]);
    ivec3 g[3] = ivec3[3](grid_vertices[v.x].xyz, grid_vertices[v.y].xyz, grid_vertices[v.z].xyz);
    ivec3 qi = sites[triple.y].xyz, qj = sites[triple.z].xyz, qk = sites[triple.w].xyz;
    Row j, l;
    for (uint c = 0u; c < ROLLED(3); c++) {
        j.v[c] = cornerValue(qi, qj, g[c]);
        l.v[c] = cornerValue(qi, qk, g[c]);
    }
    Minors m = minorsOf(j, l);
    Wide128 den = magnitude(sumOf(m));
    uint64_t t1 = fractionOf(magnitude(m.m[1]), den), t2 = fractionOf(magnitude(m.m[2]), den);
    int64_t x = fixedBetween(g[0].x, g[1].x, t1) + fixedBetween(0, g[2].x - g[0].x, t2);
    int64_t y = fixedBetween(g[0].y, g[1].y, t1) + fixedBetween(0, g[2].y - g[0].y, t2);
    int64_t z = fixedBetween(g[0].z, g[1].z, t1) + fixedBetween(0, g[2].z - g[0].z, t2);
    vec3 p0 = modelVertex(v.x), p1 = modelVertex(v.y), p2 = modelVertex(v.z);
    precise vec3 p = p0 + fractionToFloat(t1) * (p1 - p0) + fractionToFloat(t2) * (p2 - p0);

    uint zero = wideSign(m.m[0]) == 0 ? 0u : (wideSign(m.m[1]) == 0 ? 1u : (wideSign(m.m[2]) == 0 ? 2u : 3u));
    uint ea = (zero + 1u) % 3u, eb = (zero + 2u) % 3u;
    bool swapped = v[ea] > v[eb];
    uint a = swapped ? eb : ea, b = swapped ? ea : eb;
    bool by_j = j.v[a] != j.v[b];
    int64_t da = by_j ? j.v[a] : l.v[a], db = by_j ? j.v[b] : l.v[b];
    int64_t num = isNegative(da) ? -da : da, total = num + (isNegative(db) ? -db : db);
    bool on_edge = zero < 3u && !isZero(total);
    uint64_t t = fractionOf(wideFrom(num), wideFrom(total));
    if (on_edge) {
        x = fixedBetween(g[a].x, g[b].x, t);
        y = fixedBetween(g[a].y, g[b].y, t);
        z = fixedBetween(g[a].z, g[b].z, t);
        vec3 pa = modelVertex(v[a]), pb = modelVertex(v[b]);
        precise vec3 q = pa + fractionToFloat(t) * (pb - pa);
        p = t == (uint64_t(1) << 32) ? pb : q;
    }
    uint id = counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS] + k;
    savePoint(id, x, y, z);
    positions[id] = vec4(p, 0.0);
}
