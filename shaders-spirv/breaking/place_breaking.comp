// Sites of all that breaks, each inside its object: a workgroup a site, whose lanes share the triangles that tell inside from
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
#include "lib/sine_hash.glsl"
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

ivec3 drawEvenly(uint site, uint attempt, BreakingRecord object) {
    ivec3 p;
    for (uint k = 0u; k < 3u; k++)
        p[k] = object.low[k] + int(below(draw(site, attempt, k), uint(object.high[k] - object.low[k] + 1)));
    return p;
}

// Every other site of a solid lies evenly: all of it is strained (modules/brittle/effects/material.h).
bool isEven(uint site, uint attempt, int placement) {
    bool always = placement == SITES_EVEN || placement == SITES_FLAT_EVEN || (placement == SITES_SOLID && (site & 1u) != 0u);
    return always || attempt >= IMPACT_DRAWS;
}

bool drawFor(uint site, uint attempt, BreakingRecord object, out ivec3 p) {
    int placement = object.across.w;
    bool even = isEven(site, attempt, placement), found = true;
    if (placement == SITES_FLAT || placement == SITES_FLAT_EVEN) found = drawOnPlate(site, attempt, object, even, p);
    else if (placement == SITES_RADIAL) found = drawRadial(site, attempt, object, p);
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
    bool done = false;
    for (uint turn = 0u; turn < IMPACT_DRAWS + EVEN_DRAWS && !done && budget > 0u; turn++) {
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
