// Islands of surfaces that touch themselves along edges: the same as unite_triangles, but at such an edge only triangles that bound the
// same wedge of solid are one piece. Edges of the mesh that merely lie on each other, with other ends, are different wedges. Runs
// twice. The second time, sides that have found no partner join all that lie there: those of caps, and those that met because a
// triangle without area was dropped.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"

layout(constant_id = 0) const uint kSecond = 0u;
const uint PAIRED = 0x80000000u;
FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, uvec4, pieces);
layout(set = 0, binding = 2, std430) coherent buffer parents_block { uint parents[]; };
UPDATES(3, uint, edge_table); // 3 triangle + edge + 1, with PAIRED for sides that have a partner; 0: free
READS(4, uint, sources);
READS(5, uint, wedges);       // of sides of the mesh's triangles
READS(6, uvec4, polygon_offsets);
READS(7, uint, polygon_sides);
layout(push_constant) uniform Push { uint table_mask; };
#include "lib/union_find.glsl"

// The polygon that a triangle of a fan belongs to.
uint polygonOf(uint fan) {
    uint low = 0u, high = counts[COUNT_POLYGONS];
    for (uint step = 0u; step < 32u && low + 1u < high; step++) {
        uint middle = (low + high) / 2u;
        bool before = polygon_offsets[middle].w <= fan;
        low = before ? middle : low;
        high = before ? high : middle;
    }
    return low;
}

// The side of the polygon that edge k of the triangle is; NO_INDEX for edges within the fan.
uint sideOf(uint fan, uint k) {
    uint q = polygonOf(fan), first = polygon_offsets[q].x, last = polygon_offsets[q + 1u].x - 1u;
    uint corner = fan - polygon_offsets[q].w + 2u;
    if (k == 1u) return first + corner;
    if (k == 0u) return corner == 2u ? first + 1u : NO_INDEX;
    return first + corner == last ? first : NO_INDEX;
}

// The edge of the mesh's triangle on which edge k of the piece lies; NO_INDEX where it lies on none.
uint meshEdgeOf(uint t, uint k) {
    uint whole = counts[COUNT_MESH_TRIANGLES];
    if (t < whole) return k;
    uint side = t - whole < counts[COUNT_FAN_TRIANGLES] ? sideOf(t - whole, k) : NO_INDEX;
    uint label = side != NO_INDEX ? polygon_sides[side] : 0u;
    return label >= EDGE_BASE && label < EDGE_BASE + 3u ? label - EDGE_BASE : NO_INDEX;
}

uvec4 edgeKey(uint t, uint k) {
    uvec4 piece = pieces[t];
    uint a = piece[k], b = piece[(k + 1u) % 3u], edge = meshEdgeOf(t, k);
    return uvec4(min(a, b), max(a, b), piece.w, edge != NO_INDEX ? wedges[3u * sources[t] + edge] : NO_INDEX);
}

uint hashOf(uvec4 key) {
    uint hash = key.x * 0x9e3779b1u ^ (key.y * 0x85ebca6bu + (key.x >> 13)) ^ key.z * 0xc2b2ae35u;
    hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
    return hash ^ (hash >> 13);
}

uint sideIn(uint held) { return (held & ~PAIRED) - 1u; }

bool insert(uint t, uint k, uvec4 key) {
    uint hash = hashOf(key);
    for (uint probe = 0u; probe < 1024u; probe++) {
        uint at = (hash + probe) & table_mask, held = atomicCompSwap(edge_table[at], 0u, 3u * t + k + 1u);
        if (held == 0u) return true;
        uint side = sideIn(held);
        if (edgeKey(side / 3u, side % 3u) != key) continue;
        atomicOr(edge_table[at], PAIRED);
        return unite(side / 3u, t);
    }
    return false;
}

bool hasPartner(uvec4 key) {
    uint hash = hashOf(key);
    for (uint probe = 0u; probe < 1024u; probe++) {
        uint held = edge_table[(hash + probe) & table_mask];
        if (held == 0u) return false;
        uint side = sideIn(held);
        if (edgeKey(side / 3u, side % 3u) == key) return (held & PAIRED) != 0u;
    }
    return false;
}

bool joinAll(uint t, uvec4 key) {
    uint hash = hashOf(key);
    for (uint probe = 0u; probe < 1024u; probe++) {
        uint held = edge_table[(hash + probe) & table_mask];
        if (held == 0u) return true;
        uint side = sideIn(held);
        if (edgeKey(side / 3u, side % 3u).xyz == key.xyz && !unite(side / 3u, t)) return false;
    }
    return false;
}

void main() {
    uint t = flatIndex();
    if (t >= counts[COUNT_TRIANGLES] || counts[STATUS_FAILED] != 0u || pieces[t].w == NO_INDEX) return;
    bool settled = true;
    for (uint k = 0u; k < 3u; k++) {
        uvec4 key = edgeKey(t, k);
        if (kSecond == 0u) settled = insert(t, k, key) && settled;
        else if (key.w == NO_INDEX || !hasPartner(key)) settled = joinAll(t, key) && settled;
    }
    if (!settled) atomicAdd(counts[STATUS_BAD_UNION], 1u);
}
