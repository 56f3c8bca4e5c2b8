// All that becomes of a few sites before they are cut, by one workgroup in shared memory: those at one place are welded to the
// first, what is left is numbered in order and sorted into the bins of the search grid. With many sites this takes weld_sites,
// resolve_points, flag_sites, keep_sites, bin_sites, order_bins and two prefix sums, and each dispatch costs as much as it does.
//
// Sites of one place share a bin, so a look at the others of a bin tells the first of each place and its rank among those that
// stay; in which order lanes filled the bin makes no difference.
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
    ivec4 box_low;
    uint site_count; // up to FEW_SITES, in no more bins
};
#include "lib/bin_lines.glsl"
#include "lib/publish.glsl"

shared uint bin_of[FEW_SITES]; // NO_INDEX for a site without a place
shared uint loose[FEW_SITES];  // bin by bin
shared uint number[FEW_SITES]; // 1 for a site that stays, then how many stay before it
shared uint first_of[FEW_SITES + 1], kept_in[FEW_SITES], cursor[FEW_SITES];

void sync() { barrier(); }
#include "lib/sum_before.glsl"

uint binCount() { return uint(bins.x * bins.y * bins.z); }
ivec3 placeOf(uint s) { return ivec3(int(raw_sites[3u * s]), int(raw_sites[3u * s + 1u]), int(raw_sites[3u * s + 2u])); }

void countBins(uint lane) {
    for (uint b = lane; b < binCount(); b += LANES) {
        kept_in[b] = 0u;
        cursor[b] = 0u;
    }
    sync();
    for (uint s = lane; s < site_count; s += LANES) {
        bool here = placed[s] != 0u;
        uint bin = here ? binIndex(binOf(placeOf(s))) : NO_INDEX;
        bin_of[s] = bin;
        if (here) atomicAdd(kept_in[bin], 1u);
        else atomicAdd(counts[STATUS_UNPLACED], 1u);
    }
    sync();
}

// first_of[b]: the sum of kept_in before b.
void sumBins(uint lane) {
    uint per_lane = (binCount() + LANES - 1u) / LANES, first = min(lane * per_lane, binCount());
    uint last = min(first + per_lane, binCount()), sum = 0u;
    for (uint b = first; b < last; b++) sum += kept_in[b];
    uint running = sumBefore(lane, sum);
    for (uint b = first; b < last; b++) {
        first_of[b] = running;
        running += kept_in[b];
    }
    if (lane == LANES - 1u) first_of[binCount()] = lane_sum[lane];
    sync();
}

void fillBins(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        uint bin = bin_of[s];
        if (bin != NO_INDEX) loose[first_of[bin] + atomicAdd(cursor[bin], 1u)] = s;
    }
    sync();
    for (uint b = lane; b < binCount(); b += LANES) kept_in[b] = 0u;
    sync();
}

void markFirsts(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        uint bin = bin_of[s], begin = bin == NO_INDEX ? 0u : first_of[bin], end = bin == NO_INDEX ? 0u : first_of[bin + 1u];
        ivec3 place = placeOf(s);
        bool first = bin != NO_INDEX;
        for (uint k = begin; k < end; k++) first = first && (loose[k] >= s || placeOf(loose[k]) != place);
        number[s] = first ? 1u : 0u;
        if (first) atomicAdd(kept_in[bin], 1u);
        else if (bin != NO_INDEX) atomicAdd(counts[STATUS_WELDED], 1u);
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

// The rank of each site that stays among those of its bin, above the bin.
void rankInBins(uint lane) {
    for (uint s = lane; s < site_count; s += LANES) {
        bool stays = number[s] != 0u;
        uint bin = bin_of[s], begin = stays ? first_of[bin] : 0u, end = stays ? first_of[bin + 1u] : 0u, rank = 0u;
        for (uint k = begin; k < end; k++) rank += loose[k] < s ? number[loose[k]] : 0u;
        if (stays) bin_of[s] = bin | (rank << 16);
    }
    sync();
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
    uint lane = gl_LocalInvocationID.x;
    countBins(lane);
    sumBins(lane);
    fillBins(lane);
    markFirsts(lane);
    rankInBins(lane);
    sumBins(lane);
    uint total = numberSites(lane);
    writeSites(lane);
    if (lane == 0u) publishCount(COUNT_SITES, total, site_count);
}
