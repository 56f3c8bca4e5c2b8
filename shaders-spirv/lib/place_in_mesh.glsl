// Random places on the event's grid, and whether they lie inside the solid. Integers only, keyed by (seed, site, try), so that
// every device places the same sites. Inside or outside is the winding number along +z, exact, with the point moved by
// (eps, eps^2) in x and y against ties.
//
// Wants grid_vertices, triangles, column_start, column_triangles, columns and the push constants low, high, seed_low and
// seed_high declared, and lib/wide.glsl.

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

// Some column may have no triangles at all: there is nothing inside of it.
uint columnOf(ivec3 p) { return uint((p.y - low.y) / low.w * high.w + (p.x - low.x) / low.w); }

bool insideSolid(ivec3 p, bool asked, inout uint budget) {
    uint column = asked ? columnOf(p) : 0u, last = asked ? column_start[column + 1u] : 0u;
    int winding = 0;
    for (uint k = asked ? column_start[column] : 0u; k < last && budget > 0u; k++) {
        uint t = column_triangles[k];
        winding += windingAbove(grid_vertices[triangles[3u * t]].xyz, grid_vertices[triangles[3u * t + 1u]].xyz,
                                grid_vertices[triangles[3u * t + 2u]].xyz, p);
        budget -= min(budget, 1u);
    }
    return winding > 0 && budget > 0u;
}
