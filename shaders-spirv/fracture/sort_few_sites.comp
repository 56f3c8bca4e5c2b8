// All that becomes of a few sites before they are cut, by one workgroup in shared memory: those at one place are welded to the
// first, what is left is numbered in order and sorted into the bins of the search grid. With many sites this takes weld_sites,
// resolve_points, flag_sites, keep_sites, bin_sites, order_bins and two prefix sums, and each dispatch costs as much as it does.
//
// Sites of one place share a bin, so a look at the others of a bin tells the rank of each in it, and whether there may be another
// of its place. Where none is, as nearly always, that is all; else the first of each place are told and numbered. In which order
// lanes filled the bin makes no difference.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"

#define LANES GROUP_SIZE
GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, uint, raw_sites);
READS(2, uint, placed);
WRITES(3, ivec4, sites); // position on the grid; w: which of the sites asked for
WRITES(4, uint, bin_start);
WRITES(5, ivec4, bin_sites); // position and id
WRITES(6, uint, args);
layout(push_constant) uniform Push {
    ivec4 bins;
    ivec4 box_low; // w: tiles
};
#include "lib/bin_lines.glsl"
#include "lib/publish.glsl"

shared uint bin_of[FEW_SITES]; // with the rank in it above; NO_INDEX for a site without a place
shared uint loose[FEW_SITES];  // bin by bin, in any order
shared uint first_of[FEW_SITES + 1], held_by[FEW_SITES];
shared uint mark_of[FEW_SITES]; // equal for sites of one place
shared uint number[FEW_SITES];  // its place in `loose`, then 1 for a site that stays, then how many stay before it
shared uint some_go;            // sites without a place, or with one that may be another's

void sync() { barrier(); }
#include "lib/sum_before.glsl"

uint site_count; // that were asked for: up to FEW_SITES, in no more bins

uint binCount() { return uint(bins.x * bins.y * bins.z * box_low.w); }
ivec3 placeOf(uint s) { return ivec3(int(raw_sites[3u * s]), int(raw_sites[3u * s + 1u]), int(raw_sites[3u * s + 2u])); }
uint markOf(uvec3 p) { return p.x * 0x9e3779b1u ^ p.y * 0x85ebca77u ^ p.z * 0xc2b2ae3du; }
uint binOfSite(uint s) { return bin_of[s] == NO_INDEX ? NO_INDEX : bin_of[s] & 0xffffu; }

void clearBins(uint lane) {
    for (uint b = lane; b < binCount(); b += LANES) held_by[b] = 0u;
    sync();
}

void countBins(uint lane) {
    if (lane == 0u) some_go = 0u;
    clearBins(lane);
    for (uint s = lane; s < site_count; s += LANES) {
        bool here = placed[s] != 0u;
        ivec3 place = placeOf(s);
        uint bin = here ? binIndexOf(place) : NO_INDEX;
        bin_of[s] = bin;
        mark_of[s] = markOf(uvec3(place));
        if (here) number[s] = atomicAdd(held_by[bin], 1u);
        else {
            atomicAdd(counts[STATUS_UNPLACED], 1u);
            some_go = 1u;
        }
    }
    sync();
}

// first_of[b]: the sum of held_by before b.
void sumBins(uint lane) {
    uint per_lane = (binCount() + LANES - 1u) / LANES, first = min(lane * per_lane, binCount());
    uint last = min(first + per_lane, binCount()), sum = 0u;
    for (uint b = first; b < last; b++) sum += held_by[b];
    uint running = sumBefore(lane, sum);
    for (uint b = first; b < last; b++) {
        first_of[b] = running;
        running += held_by[b];
    }
    if (lane == LANES - 1u) first_of[binCount()] = lane_sum[lane];
    sync();
}

void fillBins(uint lane) {
    for (uint s = lane; s < site_count; s += LANES)
        if (bin_of[s] != NO_INDEX) loose[first_of[bin_of[s]] + number[s]] = s;
    sync();
}

// As if all stayed. Marks are compared, not places, since lanes step through this together and words of a buffer are dear.
void rankAll(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        uint bin = bin_of[s], mark = mark_of[s], rank = 0u;
        uint begin = bin == NO_INDEX ? 0u : first_of[bin], end = bin == NO_INDEX ? 0u : first_of[bin + 1u];
        for (uint k = begin; k < end; k++) {
            uint other = loose[k];
            rank += other < s ? 1u : 0u;
            if (other != s && mark_of[other] == mark) some_go = 1u;
        }
        number[s] = s;
        if (bin != NO_INDEX) bin_of[s] = bin | (rank << 16);
    }
    sync();
}

void markFirsts(uint lane) {
    clearBins(lane);
    for (uint s = lane; s < site_count; s += LANES) {
        uint bin = binOfSite(s), begin = bin == NO_INDEX ? 0u : first_of[bin], end = bin == NO_INDEX ? 0u : first_of[bin + 1u];
        ivec3 place = placeOf(s);
        bool first = bin != NO_INDEX;
        for (uint k = begin; k < end; k++) first = first && (loose[k] >= s || placeOf(loose[k]) != place);
        number[s] = first ? 1u : 0u;
        if (first) atomicAdd(held_by[bin], 1u);
        else if (bin != NO_INDEX) atomicAdd(counts[STATUS_WELDED], 1u);
    }
    sync();
}

void rankFirsts(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        bool stays = number[s] != 0u;
        uint bin = binOfSite(s), begin = stays ? first_of[bin] : 0u, end = stays ? first_of[bin + 1u] : 0u, rank = 0u;
        for (uint k = begin; k < end; k++) rank += loose[k] < s ? number[loose[k]] : 0u;
        if (stays) bin_of[s] = bin | (rank << 16);
    }
    sync();
}

// Returns how many stay. Each lane numbers a run of sites.
uint numberSites(uint lane) {
    uint per_lane = (site_count + LANES - 1u) / LANES, first = min(lane * per_lane, site_count);
    uint last = min(first + per_lane, site_count), sum = 0u;
    for (uint s = first; s < last; s++) sum += number[s];
    uint running = sumBefore(lane, sum);
    for (uint s = first; s < last; s++) {
        bool stays = number[s] != 0u;
        number[s] = stays ? running : NO_INDEX;
        running += stays ? 1u : 0u;
    }
    uint total = lane_sum[LANES - 1];
    sync();
    return total;
}

// Returns how many stay.
uint keepFirsts(uint lane) {
    markFirsts(lane);
    rankFirsts(lane);
    sumBins(lane);
    return numberSites(lane);
}

void writeSites(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        uint id = number[s], bin = bin_of[s] & 0xffffu, rank = bin_of[s] >> 16;
        ivec3 place = placeOf(s);
        if (id != NO_INDEX) {
            sites[id] = ivec4(place, int(s));
            bin_sites[first_of[bin] + rank] = ivec4(place, int(id));
        }
    }
    for (uint b = lane; b <= binCount(); b += LANES) bin_start[b] = first_of[b];
}

void main() {
    site_count = counts[STATUS_FAILED] == 0u ? counts[COUNT_ASKED_SITES] : 0u;
    uint lane = gl_LocalInvocationID.x, total = site_count;
    countBins(lane);
    sumBins(lane);
    fillBins(lane);
    rankAll(lane);
    if (some_go != 0u) total = keepFirsts(lane);
    writeSites(lane);
    if (lane == 0u) publishCount(COUNT_SITES, total, site_count);
}
