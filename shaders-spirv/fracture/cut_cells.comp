// Box Cutting (the paper, section 3) with a filter: one lane builds one cell in fp32, and what is not certain is left to the
// exact kernel, with the whole cell where planes, corners or turns run out. Lanes of a subgroup take sites of neighboring bins.
//
// One cell, three ways to look for its neighbors: SEARCH_GRID, SEARCH_LINEAR, SEARCH_TREE.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifndef NO_VOTE
#extension GL_KHR_shader_subgroup_vote : require
#endif
#include "lib/kernel.glsl"

FLAT_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, bin_sites); // position and id, bin by bin
WRITES(2, uint, raw);
WRITES(3, uvec2, cell_raw);
WRITES(4, uint, queue); // cells that are left to the exact kernel
UPDATES(5, uint, args);
layout(push_constant) uniform Push {
    ivec4 bins; // w: edge of a bin
    ivec4 box_low;
    ivec4 box_high;
    // Loop turns that a lane may take. Mesa's software device stops a subgroup at 65,535 without a word, and lanes that run in
    // step may each take theirs at different times. Unrolled loops take none.
    uint turn_budget;
};
#include "lib/queue_cell.glsl"
#include "lib/fast_cell.glsl"
#include "lib/cell_order.glsl"
#ifdef SEARCH_LINEAR
#include "lib/search_linear.glsl"
#elif defined(SEARCH_TREE)
READS(6, uvec4, tree);
READS(7, uint, leaf_start);
READS(8, uint, leaf_sites);
#include "lib/search_tree.glsl"
#else
READS(6, uint, bin_start);
#include "lib/search_grid.glsl"
#endif

void nextPhase(ivec3 site) {
    bool ends = searchEnds(site);
    // Who ran out of turns left candidates behind, even where the search has ended.
    if (budget == 0u && phase != kFinished) status = CELL_UNDECIDED;
    if (phase == kPutOff) phase = kFinished;
    else if (ends && phase == kSearching) phase = put_off_count > 0u ? kPutOff : kFinished;
    if (status != CELL_OK) phase = kFinished;
}

void main() {
    uint lane = flatIndex();
    bool has_cell = lane < counts[COUNT_SITES];
#ifndef SEARCH_LINEAR // it needs all lanes of a workgroup
    if (!has_cell) return;
#endif
    ivec4 own = bin_sites[has_cell ? lane : 0u];
    ivec3 site = own.xyz;
    beginCell(site);
    if (!has_cell) phase = kFinished;
    beginSearch(lane, site);
    for (uint turn = 0u; turn < MOST_SEARCH_TURNS && searchGoesOn(); turn++) {
        fillList(lane, site);
        listPutOff(site);
        cutByListed(lane, site);
        nextPhase(site);
    }
    if (phase != kFinished) status = CELL_UNDECIDED;
    if (has_cell) writeCell(uint(own.w));
}
