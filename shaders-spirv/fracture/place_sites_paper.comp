// Sites as the paper places them (lib/draw_paper.glsl): eight candidates a site, of which the one nearest to the impact is taken
// with a probability that grows with its strength, else the first. 256 lanes make 32 sites. Random numbers are the paper's sine
// hash (listing 1), in fixed point, so that all devices draw the same; candidates outside the solid are drawn again.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"

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
#include "lib/draw_paper.glsl"

shared ivec4 candidates[SITES * CANDIDATES]; // w: whether it lies inside

ivec3 drawPlace(uint candidate, uint attempt) {
    PaperKey key = keyOf(candidate, attempt);
    uint t = triangleFor(key, triangle_count);
    return placeBy(key, grid_vertices[triangles[3u * t]].xyz, grid_vertices[triangles[3u * t + 1u]].xyz,
                   grid_vertices[triangles[3u * t + 2u]].xyz, (low.xyz + high.xyz) / 2);
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
    int best = chosen(lane * CANDIDATES, takesNearest(site, favor));
    if (best < 0) return;
    place(site, candidates[lane * CANDIDATES + uint(best)].xyz);
}
