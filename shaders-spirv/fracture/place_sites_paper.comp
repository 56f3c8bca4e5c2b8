// Sites as the paper places them (section 2, figure 2): on a random triangle by three steps of interpolation, a side, the
// opposite corner, the center of the box; eight candidates a site, of which the one nearest to the impact is taken with a
// probability that grows with its strength, else the first. 256 lanes make 32 sites. Random numbers are the paper's sine hash
// (listing 1), in fixed point, so that all devices draw the same; candidates outside the solid are drawn again.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"
#include "lib/sine_hash.glsl"

#define CANDIDATES 8u
#define SITES 32u
layout(local_size_x = 256) in;
UPDATES(0, uint, counts);
READS(1, ivec4, grid_vertices);
READS(2, uint, triangles);
READS(3, uint, column_start);
READS(4, uint, column_triangles);
UPDATES(5, uint, raw_sites);
UPDATES(6, uint, placed);
#include "lib/place_in_mesh.glsl"

shared ivec4 candidates[SITES * CANDIDATES]; // w: whether it lies inside

// On the way from a to b; `share` of 2^32.
ivec3 between(ivec3 a, ivec3 b, uint share) {
    ivec3 d = b - a;
    return a + ivec3((int64_t(d.x) * int64_t(share)) >> 32, (int64_t(d.y) * int64_t(share)) >> 32, (int64_t(d.z) * int64_t(share)) >> 32);
}

ivec3 drawPlace(uint candidate, uint attempt) {
    uint key = candidate + seed_low, salt = attempt * 4u + seed_high;
    uint t = below(sineHash(key, salt), triangle_count);
    ivec3 a = grid_vertices[triangles[3u * t]].xyz, b = grid_vertices[triangles[3u * t + 1u]].xyz, c = grid_vertices[triangles[3u * t + 2u]].xyz;
    ivec3 on_side = between(a, b, sineHash(key, salt + 1u)), on_triangle = between(c, on_side, sineHash(key, salt + 2u));
    return between((low.xyz + high.xyz) / 2, on_triangle, sineHash(key, salt + 3u));
}

void drawCandidate(uint lane, uint candidate, bool asked) {
    uint budget = 30000u;
    bool inside = !asked;
    ivec3 p = ivec3(0);
    for (uint attempt = first_try; attempt < first_try + TRIES_A_ROUND && !inside && budget > 0u; attempt++) {
        p = drawPlace(candidate, attempt);
        inside = insideSolid(p, true, budget);
        budget -= min(budget, 1u);
    }
    candidates[lane] = ivec4(p, inside ? 1 : 0);
}

// Negative where no candidate lies inside.
int chosen(uint first, bool favors) {
    int best = -1;
    int64_t nearest = int64_t(0);
    for (uint k = 0u; k < CANDIDATES; k++) {
        ivec4 p = candidates[first + k];
        ivec3 d = p.xyz - impact.xyz;
        int64_t square = squaredLength(d);
        bool takes = p.w != 0 && (best < 0 || (favors && isNegative(square - nearest)));
        best = takes ? int(k) : best;
        nearest = takes ? square : nearest;
    }
    return best;
}

void main() {
    uint lane = gl_LocalInvocationID.x, first_site = flatGroup() * SITES, site = first_site + lane;
    uint drawn_for = first_site + lane / CANDIDATES;
    drawCandidate(lane, drawn_for * CANDIDATES + lane % CANDIDATES, drawn_for < site_count && placed[min(drawn_for, site_count - 1u)] == 0u);
    barrier();
    if (lane >= SITES || site >= site_count || placed[site] != 0u) return;
    int best = chosen(lane * CANDIDATES, draw(site, 0u, 0u) < favor);
    if (best < 0) return;
    place(site, candidates[lane * CANDIDATES + uint(best)].xyz);
}
