// Sites inside the mesh, those outside the solid drawn again: evenly, or (IMPACT) about a place where it is hit.
//
// Evenly: a first draw picks one of the columns that the surface covers, the next ones a place in it, up to the height of the
// tallest; of thin models at an angle to the axes, too, the columns hold little else.
//
// About an impact the density is even within the contact radius r0 and falls as r^-4 outside. The radius comes from the
// inverse of its cumulated density, u = (r / r0)^3 / 3 up to r0, then 4/3 - r0 / r; a point drawn evenly from a ball has the
// direction and, within r0, the radius as well.
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
#include "lib/place_in_mesh.glsl"

#ifdef IMPACT
#include "lib/integer_root.glsl"

// A point of the ball of radius 2^15, or, three times in seven, none.
bool drawInBall(uint site, uint attempt, out ivec3 d) {
    d = ivec3(below(draw(site, attempt, 0u), 65537u), below(draw(site, attempt, 1u), 65537u), below(draw(site, attempt, 2u), 65537u)) - 32768;
    int64_t square = squaredLength(d);
    return !isNegative((int64_t(1) << 30) - square) && d != ivec3(0);
}

bool drawPlace(uint site, uint attempt, out ivec3 p) {
    ivec3 d;
    bool in_ball = drawInBall(site, attempt, d);
    // u of 2^32 runs from 0 to 4/3 - r0 / furthest; the core has a third.
    uint64_t one = uint64_t(1) << 32, radius = uint64_t(impact.w);
    uint64_t range = 4ul * one / 3ul - (radius << 32) / uint64_t(furthest);
    uint64_t u = (uint64_t(draw(site, attempt, 3u)) * (range >> 1)) >> 31; // the product has 64 bits
    bool core = (u >> 32) == 0ul && uint(u) < 0x55555555u;
    uint64_t tail = (radius << 32) / max(4ul * one / 3ul - u, 1ul);
    uint size = rootOf64(uint64_t(squaredLength(d)));
    int64_t scale = int64_t(core ? radius : tail);
    int64_t divisor = int64_t(core ? 32768u : max(size, 1u));
    p = impact.xyz + ivec3(int64_t(d.x) * scale / divisor, int64_t(d.y) * scale / divisor, int64_t(d.z) * scale / divisor);
    return in_ball && all(greaterThanEqual(p, low.xyz)) && all(lessThanEqual(p, high.xyz));
}
#else
bool drawPlace(uint site, uint attempt, out ivec3 p) {
    ivec4 c = columns[below(draw(site, attempt, 0u), occupied)];
    p.x = low.x + c.x * low.w + int(below(draw(site, attempt, 1u), uint(low.w)));
    p.y = low.y + c.y * low.w + int(below(draw(site, attempt, 2u), uint(low.w)));
    p.z = c.z + int(below(draw(site, attempt, 3u), tallest + 1u));
    return p.x <= high.x && p.y <= high.y && p.z <= c.w;
}
#endif

void main() {
    uint site = flatIndex();
    if (site >= site_count) return;
    bool done = placed[site] != 0u;
    uint budget = 40000u, attempt = first_try, last_try = first_try + TRIES_A_ROUND;
    for (uint turn = 0u; turn < TRIES_A_ROUND && !done && attempt < last_try && budget > 0u; turn++) {
        ivec3 p = ivec3(0);
        bool candidate = false;
        for (; attempt < last_try && !candidate; attempt++) {
            candidate = drawPlace(site, attempt, p);
            budget -= min(budget, 1u);
        }
        done = insideSolid(p, candidate, budget);
        if (done) place(site, p);
    }
}
