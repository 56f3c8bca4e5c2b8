// Sites as the paper places them (lib/draw_paper.glsl): some candidates a site, of which the one nearest to the impact is taken
// with a probability that grows with its strength, else the first. A lane draws one candidate: of the paper's eight a group
// makes 32 sites. Random numbers are the paper's sine hash (listing 1), in fixed point, so that all devices draw the same;
// candidates outside the solid are drawn again.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/wide.glsl"

layout(local_size_x = PAPER_LANES) in;
UPDATES(0, uint, counts);
READS(1, ivec4, grid_vertices);
READS(2, uint, triangles);
READS(3, uint, column_start);
READS(4, uint, column_triangles);
UPDATES(5, uint, raw_sites);
UPDATES(6, uint, placed);
#include "lib/place_in_mesh.glsl"
#include "lib/draw_paper.glsl"

shared ivec4 drawn[PAPER_LANES]; // w: whether it lies inside

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
    drawn[lane] = ivec4(p, inside ? 1 : 0);
}

// Negative where no candidate lies inside.
int chosen(uint first, bool favors) {
    int best = -1;
    int64_t nearest = int64_t(0);
    for (uint k = 0u; k < candidates; k++) {
        ivec4 p = drawn[first + k];
        ivec3 d = p.xyz - impact.xyz;
        int64_t square = squaredLength(d);
        bool takes = p.w != 0 && (best < 0 || (favors && isNegative(square - nearest)));
        best = takes ? int(k) : best;
        nearest = takes ? square : nearest;
    }
    return best;
}

void main() {
    uint sites = PAPER_LANES / candidates; // a group; where that leaves a rest, lanes draw for none
    uint lane = gl_LocalInvocationID.x, first_site = flatGroup() * sites, site = first_site + lane;
    uint of = lane / candidates, drawn_for = first_site + of;
    bool asked = of < sites && drawn_for < site_count && placed[min(drawn_for, site_count - 1u)] == 0u;
    drawCandidate(lane, drawn_for * candidates + lane % candidates, asked);
    barrier();
    if (lane >= sites || site >= site_count || placed[site] != 0u) return;
    int best = chosen(lane * candidates, takesNearest(site, favor));
    if (best < 0) return;
    place(site, drawn[lane * candidates + uint(best)].xyz);
}
