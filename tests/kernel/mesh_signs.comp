// lib/edge_predicate.glsl and lib/triangle_predicate.glsl on one set of sites and one triangle a lane.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/corner_values.glsl"
#include "lib/edge_predicate.glsl"
#include "lib/triangle_predicate.glsl"

FLAT_KERNEL;
READS(0, ivec4, inputs); // sites self, j, k, l (w: id), then three corners
WRITES(1, ivec4, signs); // edge a-b at j for l; triangle at (j, k), at (edge 0, j), at (j, edge 2) for l; 9: no such point
layout(push_constant) uniform Push { uint length; };

Row bisectorRow(ivec4 self, ivec4 site, ivec3 a, ivec3 b, ivec3 c) {
    Row row;
    row.v = int64_t[3](cornerValue(self.xyz, site.xyz, a), cornerValue(self.xyz, site.xyz, b), cornerValue(self.xyz, site.xyz, c));
    row.id = uint(site.w);
    return row;
}

Row edgeRow(uint edge) {
    Row row;
    for (uint k = 0u; k < 3u; k++) row.v[k] = (edge + 2u) % 3u == k ? int64_t(1) : int64_t(0);
    row.id = EDGE_BASE + edge;
    return row;
}

int signAt(uint self, Row first, Row second, Row l) {
    return wideSign(sumOf(minorsOf(first, second))) == 0 ? 9 : triangleSign(self, first, second, l);
}

void main() {
    uint n = flatIndex();
    if (n >= length) return;
    ivec4 self = inputs[7u * n];
    ivec3 a = inputs[7u * n + 4u].xyz, b = inputs[7u * n + 5u].xyz, c = inputs[7u * n + 6u].xyz;
    Row j = bisectorRow(self, inputs[7u * n + 1u], a, b, c), k = bisectorRow(self, inputs[7u * n + 2u], a, b, c);
    Row l = bisectorRow(self, inputs[7u * n + 3u], a, b, c);
    uint id = uint(self.w);
    int edge = j.v[0] == j.v[1] ? 9 : edgeSign(id, j.id, l.id, j.v[0], j.v[1], l.v[0], l.v[1]);
    signs[n] = ivec4(edge, signAt(id, j, k, l), signAt(id, edgeRow(0u), j, l), signAt(id, j, edgeRow(2u), l));
}
