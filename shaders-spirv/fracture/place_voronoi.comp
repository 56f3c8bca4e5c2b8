// Voronoi vertices from the exact numerators of their four sites, relative to the lowest.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

FLAT_KERNEL;
READS(0, uint, counts);
READS(1, ivec4, sites);
READS(2, uvec4, vertex_sites);
WRITES(3, uint, points);
WRITES(4, vec4, positions);
layout(push_constant) uniform Push { float step_size; }; // model units per grid step
#include "lib/place.glsl"
#include "lib/quotient.glsl"
#include "lib/tile.glsl"

// Of a coordinate with its fraction.
float toModel(int64_t x, int tile) {
    int64_t centered = x - (int64_t(tile) << POINT_FRACTION_BITS) - (int64_t(1) << 47);
    precise float p = (float(int(centered >> 24)) + float(uint(centered) & 0xffffffu) * (1.0 / 16777216.0)) * step_size;
    return p;
}

void main() {
    uint v = flatIndex();
    if (v >= counts[COUNT_VORONOI_VERTICES] || counts[STATUS_FAILED] != 0u) return;
    uvec4 s = vertex_sites[v];
    ivec3 q = sites[s.x].xyz, tile = tileOf(q);
    Corner t = cornerOf(bisectorOf(sites[s.y].xyz - q, s.y), bisectorOf(sites[s.z].xyz - q, s.z), bisectorOf(sites[s.w].xyz - q, s.w));
    bool turned = wideSign(t.volume) < 0;
    Wide128 den = wideDouble(turned ? wideNegate(t.volume) : t.volume);
    int64_t x[3];
    for (uint k = 0u; k < ROLLED(3); k++) {
        x[k] = quotientOf(turned ? wideNegate(t.moment[k]) : t.moment[k], den, POINT_FRACTION_BITS) + (int64_t(q[k]) << POINT_FRACTION_BITS);
    }
    uint id = counts[COUNT_MESH_VERTICES] + counts[COUNT_CROSSINGS] + counts[COUNT_TRIPLES] + v;
    savePoint(id, x[0], x[1], x[2]);
    positions[id] = vec4(toModel(x[0], tile.x), toModel(x[1], tile.y), toModel(x[2], tile.z), 0.0);
}
