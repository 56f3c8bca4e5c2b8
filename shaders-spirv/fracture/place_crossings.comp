// Mesh vertices and crossings of mesh edges. Output coordinates interpolate the model's own, never the grid's.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, ivec4, grid_vertices);
READS(3, float, mesh_positions);
READS(4, uvec2, mesh_edges);
READS(5, uvec4, crossings);
WRITES(6, uint, points);
WRITES(7, vec4, positions);
#include "lib/place.glsl"

vec3 modelVertex(uint v) { return vec3(mesh_positions[3u * v], mesh_positions[3u * v + 1u], mesh_positions[3u * v + 2u]); }

void main() {
    uint id = flatIndex(), vertex_count = counts[COUNT_MESH_VERTICES];
    if (id >= vertex_count + counts[COUNT_CROSSINGS] || counts[STATUS_FAILED] != 0u) return;
    bool vertex = id < vertex_count;
    uvec4 crossing = vertex ? uvec4(0u) : crossings[id - vertex_count];
    uvec2 ends = vertex ? uvec2(id) : mesh_edges[crossing.z];
    ivec3 a = grid_vertices[ends.x].xyz, b = grid_vertices[ends.y].xyz, qi = sites[crossing.x].xyz, qj = sites[crossing.y].xyz;
    int64_t da = cornerValue(qi, qj, a), db = cornerValue(qi, qj, b);
    int64_t num = isNegative(da) ? -da : da, den = num + (isNegative(db) ? -db : db);
    uint64_t t = vertex || isZero(den) ? uint64_t(0) : fractionOf(wideFrom(num), wideFrom(den));
    savePoint(id, fixedBetween(a.x, b.x, t), fixedBetween(a.y, b.y, t), fixedBetween(a.z, b.z, t));
    vec3 pa = modelVertex(ends.x), pb = modelVertex(ends.y);
    precise vec3 p = pa + fractionToFloat(t) * (pb - pa);
    positions[id] = vec4(t == (uint64_t(1) << 32) ? pb : p, 0.0);
}
