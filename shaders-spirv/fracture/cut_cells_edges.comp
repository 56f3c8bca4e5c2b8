// Box Cutting (the paper, section 3) as the paper spreads it over the device: one workgroup builds one cell, a lane an edge. In
// fp32 with the filter of cut_cells, so that what is not certain is left to the exact kernel in the same way.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"

#define LANES GROUP_SIZE
#define SIEVE_CORNERS RAW_CORNERS

GROUP_KERNEL;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);     // by id
READS(2, uint, bin_start);  // grid of bins, x fastest
READS(3, ivec4, bin_sites); // position and id, bin by bin
WRITES(4, uint, raw);
WRITES(5, uvec2, cell_raw);
WRITES(6, uint, queue); // cells that are left to the exact kernel
UPDATES(7, uint, args);
layout(push_constant) uniform Push {
    ivec4 bins; // w: edge of a bin
    ivec4 box_low;
    ivec4 box_high;
};
shared uint open_sites[MOST_OPEN];
uint open_total; // the same for all lanes

#include "lib/edge_store.glsl"
#include "lib/group_search.glsl"
#include "lib/edge_cell.glsl"
#include "lib/edge_order.glsl"
#include "lib/queue_cell.glsl"

// What is uncertain waits, since a later cut may remove the corner in question; what then still is, is left open.
void putOff(uint lane, vec3 e, uint id, bool waits) {
    if (waits && lane == 0u) list_key[best_slot] = floatBitsToUint(dot(e, e)) | WAITING;
    if (waits) return;
    if (open_total >= MOST_OPEN) status = CELL_UNDECIDED;
    if (lane == 0u) open_sites[min(open_total, MOST_OPEN - 1u)] = id;
    open_total++;
}

void cutByListed(uint lane, bool waiting_too) {
    for (uint step = 0u; step < 16384u && budget > 0u && status == CELL_OK; step++) {
        if (!takeNearest(lane, waiting_too)) break;
        uint id = best_site;
        vec3 e = vec3(sites[id].xyz - site);
        lookAtCorners(lane, e);
        bool cuts = removed_count != 0u, unsure = open_count != 0u;
        sync();
        if (unsure) {
            putOff(lane, e, id, !waiting_too);
        } else if (cuts) {
            cutBy(lane, e, id);
            sieveList(lane);
        }
        sync();
    }
    measureReach(lane);
}

// A cell that is not done writes no planes and no corners; one that is left open keeps its order, since who goes on with it wants
// the walls of the box where they began.
void writeCell(uint lane) {
    uint base = self * RAW_WORDS;
    // Ids of open sites stand where the last corners would.
    if (open_total != 0u && corner_top > RAW_CORNERS - MOST_OPEN && status == CELL_OK) status = CELL_UNDECIDED;
    bool ok = status == CELL_OK;
    uint planes = ok ? plane_count : 0u, corners = ok ? corner_top : 0u, open = ok ? open_total : 0u;
    markPlanes(lane);
    uint bounding = placePlanes(lane, open == 0u);
    placeCorners(lane);
    for (uint p = lane; p < planes; p += LANES) {
        bool bounds = bounds_cell[p] != 0u;
        if (bounds || open != 0u) raw[base + 2u + entry[p]] = bounds ? plane_id[p] : NO_INDEX;
    }
    for (uint t = lane; t < corners; t += LANES) {
        uint key = edge_copies[copy][t];
        raw[base + 2u + PLANES + corner_goes[t]] = (key >> 16) | (key & 0xff00u) | ((key & 0xffu) << 16);
    }
    if (lane < open) raw[base + RAW_OPEN + lane] = open_sites[lane];
    if (lane == 0u) {
        cell_raw[self] = uvec2(base, 0u);
        raw[base] = open != 0u ? CELL_OPEN | (open << 8) : status;
        if (!ok || open != 0u) queueCell(self);
        raw[base + 1u] = (ok && open == 0u ? bounding : planes) | (corners << 16);
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    if (group >= counts[COUNT_SITES] || counts[STATUS_FAILED] != 0u) return;
    ivec4 own = bin_sites[group];
    self = uint(own.w);
    site = own.xyz;
    open_total = 0u;
    startCell(lane, inTile(site), box_low.xyz, box_high.xyz);
    searchCell(lane, false);
    writeCell(lane);
}
