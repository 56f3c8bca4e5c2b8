// One round of Lloyd's relaxation (Lloyd 1982): every site goes to the centroid of its cell, where that lies in the solid.
//
// The centroid comes from the cell's edges: each is the base of two pyramids with the site for an apex and, in either face, the
// foot of the perpendicular from the site. Integers only, so that all devices place the same sites; twelve bits a coordinate
// are plenty for a place that is only aimed at.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites); // w: which of the sites asked for
READS(2, uvec2, cell_raw);
READS(3, uint, raw);
READS(4, ivec4, grid_vertices);
READS(5, uint, triangles);
READS(6, uint, column_start);
READS(7, uint, column_triangles);
UPDATES(8, uint, raw_sites);
layout(push_constant) uniform Push {
    ivec4 low;  // of the mesh on the grid; w: edge of a column
    ivec4 high; // w: columns in a row
    ivec4 box_low;
    ivec4 box_high;
    uint slots;
};
#include "lib/raw_cell.glsl"
#include "lib/tile.glsl"
#include "lib/inside_solid.glsl"
#include "lib/quotient.glsl"

const uint kBits = 12u;

ivec3 corner[RAW_CORNERS]; // from the site
ivec3 site;

Plane planeOf(uint id) {
    if (id >= BOX_BASE) return wallOf(id - BOX_BASE, inTile(site), box_low.xyz, box_high.xyz);
    return bisectorOf(sites[id].xyz - site, id);
}

// Of the perpendicular from the site.
ivec3 footOf(uint id) {
    Plane p = planeOf(id);
    return id >= BOX_BASE ? p.d * int(p.r >> 1) : p.d / 2;
}

ivec3 cornerPlace(uvec3 ids) {
    Corner t = cornerOf(planeOf(ids.x), planeOf(ids.y), planeOf(ids.z));
    Wide128 den = wideDouble(t.volume);
    return ivec3(quotientOf(t.moment[0], den, 0u), quotientOf(t.moment[1], den, 0u), quotientOf(t.moment[2], den, 0u));
}

// The other end of the edge between two faces that ends at corner t.
uint otherEnd(RawCell r, uint t, uint f, uint g) {
    uint found = t;
    for (uint u = 0u; u < r.corner_count; u++) {
        uvec3 c = rawCorner(r, u);
        bool on = any(equal(c, uvec3(f))) && any(equal(c, uvec3(g)));
        found = on && u != t ? u : found;
    }
    return found;
}

int64_t sixVolumes(ivec3 a, ivec3 b, ivec3 c) {
    return int64_t(a.x) * crossTerm(b.y, b.z, c.y, c.z) + int64_t(a.y) * crossTerm(b.z, b.x, c.z, c.x) +
           int64_t(a.z) * crossTerm(b.x, b.y, c.x, c.y);
}

// From the site to the centroid.
ivec3 wayToCentroid(RawCell r) {
    int reach = 1;
    for (uint t = 0u; t < r.corner_count; t++) {
        corner[t] = cornerPlace(rawCorner(r, t));
        ivec3 size = abs(corner[t]);
        reach = max(reach, max(size.x, max(size.y, size.z)));
    }
    int shift = max(0, findMSB(reach) + 1 - int(kBits));
    int64_t volume = int64_t(0), moment[3] = int64_t[3](int64_t(0), int64_t(0), int64_t(0));
    for (uint side = 0u; side < 3u * r.corner_count; side++) {
        uint t = side / 3u, k = side % 3u;
        uvec3 c = rawCorner(r, t);
        uint f = c[k], g = c[(k + 2u) % 3u]; // counterclockwise around face f the edge with g leaves corner t
        ivec3 from = corner[t] >> shift, to = corner[otherEnd(r, t, f, g)] >> shift, foot = footOf(f) >> shift;
        int64_t part = sixVolumes(foot, from, to);
        volume += part;
        for (uint axis = 0u; axis < 3u; axis++) moment[axis] += part * int64_t(foot[axis] + from[axis] + to[axis]);
    }
    ivec3 way = ivec3(0);
    bool solid = !isNegative(volume) && !isZero(volume);
    int64_t divisor = solid ? volume * int64_t(4) : int64_t(1);
    for (uint axis = 0u; axis < 3u; axis++) way[axis] = (int((moment[axis] << 8) / divisor) << shift) >> 8;
    return solid ? way : ivec3(0);
}

void main() {
    uint s = flatIndex();
    if (s >= min(slots, counts[COUNT_SITES]) || counts[STATUS_FAILED] != 0u) return;
    site = sites[s].xyz;
    RawCell r = openCell(s);
    bool usable = r.status == CELL_OK && r.corner_count <= RAW_CORNERS && !r.wide;
    if (!usable) return;
    ivec3 p = site + wayToCentroid(r);
    uint budget = 20000u;
    bool within = all(greaterThanEqual(p, low.xyz)) && all(lessThanEqual(p, high.xyz));
    if (!insideSolid(p, within, budget)) return;
    uint at = uint(sites[s].w);
    raw_sites[3u * at] = uint(p.x);
    raw_sites[3u * at + 1u] = uint(p.y);
    raw_sites[3u * at + 2u] = uint(p.z);
}
