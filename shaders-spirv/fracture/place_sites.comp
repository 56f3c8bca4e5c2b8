// Sites inside the mesh, those outside the solid drawn again: evenly, or (IMPACT) about a place where it is hit.
//
// Evenly: a first draw picks one of the columns that the surface covers, the next ones a place in it, up to the height of the
// tallest; of thin models at an angle to the axes, too, the columns hold little else.
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
#include "lib/draw_impact.glsl"

bool drawPlace(uint site, uint attempt, out ivec3 p) {
    return drawAbout(site, attempt, impact, furthest, p) && all(greaterThanEqual(p, low.xyz)) && all(lessThanEqual(p, high.xyz));
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
