// Sites of all that breaks, each inside its object, but for those of rings: a workgroup a site, whose lanes share the triangles that tell inside from
// outside. Drawn as the record says (SITES_*), and where that finds no place, evenly.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/tile.glsl"
#include "lib/wide.glsl"
#include "shared/breaking.h"

GROUP_KERNEL;
READS(0, uint, counts);
READS(1, BreakingRecord, breaking);
READS(2, ivec4, grid_vertices);
READS(3, uint, mesh_triangles);
READS(4, uvec4, triangle_numbers); // of triangles as they are drawn: own, of earlier cuts
WRITES(5, uint, raw_sites);
WRITES(6, uint, placed);
uint seed_low, seed_high;
#include "lib/breaking_corner.glsl"
#include "lib/draw.glsl"
#include "lib/draw_impact.glsl"
#include "lib/draw_plate.glsl"
#include "lib/draw_paper.glsl"
#include "lib/draw_radial.glsl"
#include "lib/winding.glsl"

const uint kTurnBudget = 56000u; // of the 65,535 that Mesa's software device allows

shared int winding_sum;
uint lane, budget;

// In the mesh, where triangles of one object are those of its own surface and those of earlier cuts.
struct Ranges {
    uvec2 own, earlier;
};

Ranges rangesOf(BreakingRecord object) {
    uint first = object.range.w / 3u, middle = first + object.range.y / 3u, last = middle + object.range.z / 3u;
    uint own = counts[COUNT_OWN_TRIANGLES];
    return Ranges(uvec2(triangle_numbers[first].x, triangle_numbers[middle].x),
                  own + uvec2(triangle_numbers[middle].y, triangle_numbers[last].y));
}

ivec3 cornerAt(uint triangle, uint k) { return grid_vertices[mesh_triangles[3u * triangle + k]].xyz; }

bool isInside(ivec3 p, Ranges r) {
    uint own = r.own.y - r.own.x, total = own + r.earlier.y - r.earlier.x;
    if (lane == 0u) winding_sum = 0;
    barrier();
    int winding = 0;
    for (uint k = lane; k < total; k += GROUP_SIZE) {
        uint t = k < own ? r.own.x + k : r.earlier.x + k - own;
        winding += windingAbove(cornerAt(t, 0u), cornerAt(t, 1u), cornerAt(t, 2u), p);
    }
    if (winding != 0) atomicAdd(winding_sum, winding);
    barrier();
    bool inside = winding_sum > 0;
    barrier();
    budget -= min(budget, total / GROUP_SIZE + 2u);
    return inside;
}

// The first try of a candidate that lies inside.
bool drawCandidate(uint candidate, BreakingRecord object, Ranges r, ivec3 corner, out ivec3 p) {
    uint own = r.own.y - r.own.x, total = own + r.earlier.y - r.earlier.x;
    bool found = false;
    for (uint attempt = 0u; attempt < PAPER_DRAWS && !found && budget > 0u; attempt++) {
        PaperKey key = keyOf(candidate, attempt);
        uint k = triangleFor(key, total), t = k < own ? r.own.x + k : r.earlier.x + k - own;
        p = placeBy(key, cornerAt(t, 0u) - corner, cornerAt(t, 1u) - corner, cornerAt(t, 2u) - corner, (object.low.xyz + object.high.xyz) / 2);
        found = isInside(corner + p, r);
    }
    return found;
}

// Of eight candidates the nearest to the blow, as often as its strength says, else the first.
bool drawAsPaper(uint site, BreakingRecord object, Ranges r, ivec3 corner, out ivec3 p) {
    bool favors = takesNearest(site, object.sites.z), found = false;
    int64_t nearest = int64_t(0);
    for (uint k = 0u; k < PAPER_CANDIDATES && (favors || !found); k++) {
        ivec3 candidate;
        if (!drawCandidate(site * PAPER_CANDIDATES + k, object, r, corner, candidate)) continue; // the same for all lanes
        int64_t square = squaredLength(candidate - object.impact.xyz);
        bool takes = !found || isNegative(square - nearest);
        p = takes ? candidate : p;
        nearest = takes ? square : nearest;
        found = true;
    }
    return found;
}

// Where any of its cell lies in the object; on the grid, on which there is room for it around the object.
bool drawOnSpoke(uint site, BreakingRecord object, Ranges r, ivec3 corner, out ivec3 p) {
    bool wanted = false;
    for (uint k = 0u; k < RADIAL_DRAWS && !wanted && budget > 0u; k++) {
        ivec3 at = placeInSector(site, k, object);
        bool near_ = all(greaterThanEqual(at, object.low.xyz)) && all(lessThanEqual(at, object.high.xyz)); // the same for all lanes
        if (near_) wanted = isInside(corner + at, r);
    }
    p = radialSite(site, object);
    return wanted && all(greaterThan(p, ivec3(0))) && all(lessThan(p, ivec3(1 << 24)));
}

ivec3 drawEvenly(uint site, uint attempt, BreakingRecord object) {
    ivec3 p;
    for (uint k = 0u; k < 3u; k++)
        p[k] = object.low[k] + int(below(draw(site, attempt, k), uint(object.high[k] - object.low[k] + 1)));
    return p;
}

// Every other site of a solid lies evenly: all of it is strained (modules/brittle/effects/material.h).
bool isEven(uint site, uint attempt, int placement) {
    bool always = placement == SITES_EVEN || placement == SITES_PAPER || placement == SITES_FLAT_EVEN || (placement == SITES_SOLID && (site & 1u) != 0u);
    return always || attempt >= IMPACT_DRAWS;
}

bool drawFor(uint site, uint attempt, BreakingRecord object, out ivec3 p) {
    int placement = object.across.w;
    bool even = isEven(site, attempt, placement), found = true;
    if (placement == SITES_FLAT || placement == SITES_FLAT_EVEN) found = drawOnPlate(site, attempt, object, even, p);
    else if (even) p = drawEvenly(site, attempt, object);
    else if (placement == SITES_SHELL) found = drawInShell(site, attempt, object, p);
    else found = drawAbout(site, attempt, object.impact, uint(object.low.w), p);
    return found && all(greaterThanEqual(p, object.low.xyz)) && all(lessThanEqual(p, object.high.xyz));
}

void main() {
    lane = gl_LocalInvocationID.x;
    budget = kTurnBudget;
    uint site = flatGroup();
    if (site >= counts[COUNT_ASKED_SITES] || counts[STATUS_FAILED] != 0u) return;
    uint number = objectOfSite(site), attempt = 0u;
    BreakingRecord object = breaking[number];
    seed_low = uint(object.high.w);
    seed_high = 0u;
    Ranges ranges = rangesOf(object);
    ivec3 corner = tileAt(number), p = ivec3(0);
    bool is_radial = object.across.w == SITES_RADIAL, done = false;
    if (is_radial) done = drawOnSpoke(site - object.sites.x, object, ranges, corner, p);
    else if (object.across.w == SITES_PAPER) done = drawAsPaper(site - object.sites.x, object, ranges, corner, p);
    for (uint turn = 0u; turn < IMPACT_DRAWS + EVEN_DRAWS && !is_radial && !done && budget > 0u; turn++) {
        bool candidate = false;
        for (; attempt < IMPACT_DRAWS + EVEN_DRAWS && !candidate; attempt++) {
            candidate = drawFor(site - object.sites.x, attempt, object, p);
            budget -= min(budget, 1u);
        }
        if (!candidate) break; // the same for all lanes
        done = isInside(corner + p, ranges);
    }
    if (lane == 0u) {
        // An object without any site would have no cell for its vertices; a site need not lie inside.
        bool last_resort = !done && site == object.sites.x;
        if (last_resort) p = (object.low.xyz + object.high.xyz) / 2;
        for (uint k = 0u; k < 3u; k++) raw_sites[3u * site + k] = uint(corner[k] + p[k]);
        placed[site] = done || last_resort ? 1u : 0u;
    }
}
