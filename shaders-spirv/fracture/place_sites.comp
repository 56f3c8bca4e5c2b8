// Sites inside the mesh, uniform: points of the box, those outside the solid drawn again. Integers only, keyed by (seed,
// site, try), so that every device places the same sites. A first draw picks one of the columns that the surface covers,
// which keeps thin models from rejecting nearly everything; inside or outside is the winding number along +z, exact, with
// the point moved by (eps, eps^2) in x and y against ties.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, grid_vertices);
READS(2, uint, triangles);
READS(3, uint, column_start);
READS(4, uint, column_triangles);
READS(5, ivec4, columns); // occupied ones: x, y index, lowest and highest z
UPDATES(6, uint, raw_sites);
UPDATES(7, uint, placed);
layout(push_constant) uniform Push {
    ivec4 low;  // of the mesh on the grid; w: edge of a column
    ivec4 high; // w: columns in a row
    uint site_count;
    uint occupied;
    uint seed_low;
    uint seed_high;
    uint first_try;
};

uint mixed(uint h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

uint draw(uint site, uint attempt, uint axis) {
    return mixed(mixed(mixed(mixed(seed_low + 0x9e3779b9u) ^ seed_high) + site * 0x85ebca6bu) ^ (attempt * 4u + axis + 1u));
}

uint below(uint random, uint n) { return uint((uint64_t(random) * uint64_t(n)) >> 32); }

// On which side of a -> b the moved point lies; 0 only where a and b fall together.
int sideOfEdge(ivec3 a, ivec3 b, ivec3 p) {
    int64_t s = int64_t(b.x - a.x) * int64_t(p.y - a.y) - int64_t(b.y - a.y) * int64_t(p.x - a.x);
    return !isZero(s) ? signOf(s) : (b.y != a.y ? sign(a.y - b.y) : sign(b.x - a.x));
}

int windingAbove(ivec3 a, ivec3 b, ivec3 c, ivec3 p) {
    int s = sideOfEdge(a, b, p);
    bool crossed = s != 0 && sideOfEdge(b, c, p) == s && sideOfEdge(c, a, p) == s;
    ivec3 u = b - a, w = c - a, d = p - a;
    int64_t nx = int64_t(u.y) * int64_t(w.z) - int64_t(u.z) * int64_t(w.y);
    int64_t ny = int64_t(u.z) * int64_t(w.x) - int64_t(u.x) * int64_t(w.z);
    int64_t nz = int64_t(u.x) * int64_t(w.y) - int64_t(u.y) * int64_t(w.x);
    int height = wideSign(wideAdd(wideAdd(wideMul(nx, int64_t(d.x)), wideMul(ny, int64_t(d.y))), wideMul(nz, int64_t(d.z))));
    return crossed && height * s < 0 ? s : 0;
}

void main() {
    uint site = flatIndex();
    if (site >= site_count) return;
    bool done = placed[site] != 0u;
    uint budget = 40000u, attempt = first_try, last_try = first_try + 512u;
    for (uint turn = 0u; turn < 512u && !done && attempt < last_try && budget > 0u; turn++) {
        ivec3 p = ivec3(0);
        uint column = 0u;
        bool candidate = false;
        for (; attempt < last_try && !candidate; attempt++) {
            ivec4 c = columns[below(draw(site, attempt, 0u), occupied)];
            p.x = low.x + c.x * low.w + int(below(draw(site, attempt, 1u), uint(low.w)));
            p.y = low.y + c.y * low.w + int(below(draw(site, attempt, 2u), uint(low.w)));
            p.z = low.z + int(below(draw(site, attempt, 3u), uint(high.z - low.z + 1)));
            candidate = p.x <= high.x && p.y <= high.y && p.z >= c.z && p.z <= c.w;
            column = uint(c.y * high.w + c.x);
            budget -= min(budget, 1u);
        }
        uint last = candidate ? column_start[column + 1u] : 0u;
        int winding = 0;
        for (uint k = candidate ? column_start[column] : 0u; k < last && budget > 0u; k++) {
            uint t = column_triangles[k];
            winding += windingAbove(grid_vertices[triangles[3u * t]].xyz, grid_vertices[triangles[3u * t + 1u]].xyz,
                                    grid_vertices[triangles[3u * t + 2u]].xyz, p);
            budget -= min(budget, 1u);
        }
        done = winding > 0 && budget > 0u;
        if (done) {
            raw_sites[3u * site] = uint(p.x);
            raw_sites[3u * site + 1u] = uint(p.y);
            raw_sites[3u * site + 2u] = uint(p.z);
            placed[site] = 1u;
        }
    }
}
