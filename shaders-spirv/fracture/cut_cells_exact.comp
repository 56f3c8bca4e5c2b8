// Box Cutting (the paper, section 3) in integers: one workgroup builds one cell, from the box inwards, near to far, until
// the next site is further than twice the furthest corner. Every answer that fp32 leaves open is an integer's sign.
//
// Cutting by e removes corners; what they leave is a disk on the cell's surface whose rim visits every plane at most once.
// Each removed corner (a, b, c) adds c - b style differences to its planes, inner edges cancel in pairs, and a rim plane is
// left with next - prev and next^2 - prev^2: both neighbors along the rim follow without a walk, and each rim plane p makes
// its new corner (p, next, e) on its own.
//
// The order of cuts does not change the cell, only the work: of sites on a sphere around another one, say, all bisectors all but
// meet in the center, until the center's own site cuts it off (lib/group_search.glsl).
//
// PLANES and CORNERS size the store; a cell that outgrows it, or its loop turns, is queued for the next larger kernel.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

#ifndef LANES
#define LANES 16 // a cell has a few dozen corners
#define PLANES 64
#define CORNERS 112
#endif
#define PLANE_TURNS ((PLANES + LANES - 1) / LANES)
#define TORN NO_INDEX /* for open_count: the rim is no ring */
#define SIEVE_CORNERS 160 /* with more corners a look at all of them costs more than the test it saves */

layout(local_size_x = LANES) in;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);     // by id
READS(2, uint, bin_start);  // grid of bins, x fastest
READS(3, ivec4, bin_sites); // position and id, bin by bin
UPDATES(4, uint, queue);    // cells of this kernel, then of the next larger one
UPDATES(5, uint, raw);
WRITES(6, uvec2, cell_raw); // word offset of the cell in `raw`, and the store's size class
layout(push_constant) uniform Push {
    ivec4 bins;        // per axis; w: edge of a bin in grid steps
    ivec4 box_low;     // w: first word of this kernel's queue
    ivec4 box_high;    // w: first word of the next kernel's queue
    uint cell_count;   // not NO_INDEX: all these cells, in order, without a queue
    uint size_class;   // 0, 1, 2
    uint raw_base;     // where this class begins in `raw`
    uint next_capacity;
};
#ifndef GLOBAL_STORE
UPDATES(7, uint, store); // bound, and left alone: all sizes take the same buffers
#endif
#include "lib/exact_store.glsl"
#include "lib/group_search.glsl"

void startFromBox(uint lane) {
    for (uint p = lane; p < PLANES; p += LANES) {
        rim_sum[p] = 0;
        rim_squares[p] = 0;
    }
    if (lane < 6u) setPlane(lane, wallOf(lane, inTile(site), box_low.xyz, box_high.xyz));
    startSearch(lane);
    sync();
    if (lane < 8u) {
        uint x = lane & 1u, y = 2u + ((lane >> 1) & 1u), z = 4u + (lane >> 2);
        bool odd = ((lane ^ (lane >> 1) ^ (lane >> 2)) & 1u) != 0u;
        makeCorner(lane, x, odd ? y : z, odd ? z : y);
    }
    corner_top = 8u;
    plane_count = 6u;
    sync();
}

Plane neighborOf(uint id) { return bisectorOf(sites[id].xyz - site, id); }

void removeCorner(uint t) {
    uvec2 planes = corner_planes[t];
    int a = int(planes.x & 0xffffu), b = int(planes.x >> 16), c = int(planes.y);
    corner_planes[t].y = planes.y | GONE;
    corner_place[t] = vec4(0.0); // inside of every plane
    atomicAdd(rim_sum[a], b - c);
    atomicAdd(rim_sum[b], c - a);
    atomicAdd(rim_sum[c], a - b);
    atomicAdd(rim_squares[a], b * b - c * c);
    atomicAdd(rim_squares[b], c * c - a * a);
    atomicAdd(rim_squares[c], a * a - b * b);
    atomicAdd(removed_count, 1u);
}

// Removes the corners that are certainly outside e; those in question are listed in `slots`.
void removeCertain(uint lane, vec3 d) {
    float square = dot(d, d), size = length(d);
    uint turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = k * LANES + lane;
        vec4 c = corner_place[min(t, corner_top - 1u)];
        float q = dot(d, c.xyz), slack = size * c.w;
        bool outside = kFast ? q > square : q - slack > square * (1.0 + kPlaceError);
        bool inside = kFast ? !outside : q + slack < square * (1.0 - kPlaceError);
        if (onCorner(t) && outside) removeCorner(t);
        if (onCorner(t) && !outside && !inside) slots[atomicAdd(open_count, 1u)] = t;
    }
    spend(turns);
    sync();
}

bool removes(Plane e, uint t) {
    uvec2 planes = corner_planes[t];
    if (!kExact)
        return roundedCuts(roundedPlaneAt(planes.x & 0xffffu), roundedPlaneAt(planes.x >> 16),
                           roundedPlaneAt(planes.y & ~GONE), roundedBisector(real3(e.d)));
    int side = sideOf(loadCorner(t), e);
    bool tie = tieCuts(self, planeAt(planes.x & 0xffffu), planeAt(planes.x >> 16), planeAt(planes.y & ~GONE), e);
    return side > 0 || (side == 0 && tie);
}

void removeExact(uint lane, Plane e) {
    uint total = open_count;
    for (uint k = lane; k < total; k += LANES) {
        if (removes(e, slots[k])) removeCorner(slots[k]);
    }
    spend(total / LANES + 1u);
    sync();
}

// Of all that wait at once, a candidate a lane: strikes out those that cut none of the corners in question.
void sieveWaiting(uint lane) {
    uint total = list_count;
    if (corner_top > SIEVE_CORNERS || total == 0u) return;
    for (uint t = lane; t < corner_top; t += LANES) slots[t] = 0u;
    if (lane == 0u) open_count = 0u;
    sync();
    for (uint k = lane; k < total; k += LANES) {
        bool waits = list_key[k] != NO_INDEX && (list_key[k] & WAITING) != 0u;
        vec3 d = vec3(sites[waits ? list_site[k] : self].xyz - site);
        float square = dot(d, d) * (1.0 - kPlaceError), size = length(d);
        for (uint t = 0u; t < corner_top; t++) {
            vec4 c = corner_place[t];
            if (waits && dot(d, c.xyz) + size * c.w >= square) slots[t] = 1u;
        }
    }
    sync();
    for (uint t = lane; t < corner_top; t += LANES) {
        uint at = slots[t] != 0u ? atomicAdd(open_count, 1u) : LANES;
        if (at < LANES) lane_sum[at] = t;
    }
    sync();
    uint open = open_count <= LANES ? open_count : 0u;
    spend((total / LANES + 1u) * (corner_top + open + 2u));
    for (uint k = lane; k < total && open != 0u; k += LANES) {
        bool waits = list_key[k] != NO_INDEX && (list_key[k] & WAITING) != 0u, cuts = false;
        uint id = waits ? list_site[k] : self;
        Plane e = neighborOf(id);
        for (uint q = 0u; q < open; q++) cuts = removes(e, lane_sum[q]) || cuts;
        if (waits && !cuts) list_key[k] = NO_INDEX;
    }
    sync();
}

// Gives every rim plane its new corner.
void closeRim(uint lane, uint e) {
    uint mine = 0u, turns = cornerTurns();
    [[unroll]] for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = lane * PLANE_TURNS + k;
        if (p < PLANES && rim_sum[min(p, PLANES - 1u)] != 0) mine += 1u;
    }
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k;
        if (onCorner(t) && corner_planes[min(t, CORNERS - 1u)].y >= GONE) mine += 0x10000u;
    }
    uint before = sumBefore(lane, mine), slot = before >> 16, rank = before & 0xffffu;
    uint gone = lane_sum[LANES - 1] >> 16, rim = lane_sum[LANES - 1] & 0xffffu, more = rim - min(rim, gone);
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k;
        if (onCorner(t) && corner_planes[min(t, CORNERS - 1u)].y >= GONE) slots[slot++] = t;
    }
    sync();
    bool fits = corner_top + more <= CORNERS;
    [[unroll]] for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = lane * PLANE_TURNS + k;
        int sum = p < PLANES ? rim_sum[min(p, PLANES - 1u)] : 0;
        if (sum != 0 && fits) {
            int next = (rim_squares[p] / sum + sum) / 2;
            // Where signs were rounded the rim may visit a plane twice, and sums say nothing.
            if (!kExact && (next < 0 || next >= int(plane_count))) open_count = TORN;
            if (!kExact) next = clamp(next, 0, int(plane_count) - 1);
            makeCorner(rank < gone ? slots[min(rank, CORNERS - 1u)] : corner_top + rank - gone, p, uint(next), e);
            rank++;
        }
        if (p < PLANES) {
            rim_sum[p] = 0;
            rim_squares[p] = 0;
        }
    }
    status = fits ? status : CELL_OVERFLOW;
    corner_top += fits ? more : 0u;
    spend(2u * turns);
    sync();
    if (!kExact && open_count == TORN) status = CELL_UNDECIDED;
}

void cutByListed(uint lane, bool waiting_too) {
    if (waiting_too) sieveWaiting(lane);
    for (uint step = 0u; step < 16384u && budget > 0u && status == CELL_OK; step++) {
        if (!takeNearest(lane, waiting_too)) break;
        uint id = best_site, slot = best_slot;
        Plane e = neighborOf(id);
        removeCertain(lane, vec3(e.d));
        bool certain = removed_count != 0u, open = open_count != 0u;
        sync();
        if (!certain && open && !waiting_too && lane == 0u) list_key[slot] = floatBitsToUint(dot(vec3(e.d), vec3(e.d))) | WAITING;
        if (certain || (open && waiting_too)) {
            removeExact(lane, e);
            if (removed_count != 0u) {
                if (plane_count >= PLANES - 1u) status = CELL_OVERFLOW;
                if (lane == 0u) setPlane(min(plane_count, PLANES - 1u), e);
                sync();
                closeRim(lane, plane_count);
                plane_count++;
                sieveList(lane);
            }
        }
        sync();
    }
    measureReach(lane);
}

// Goes on with what the filtered kernel left: all is cut but for a few sites. The walls of the box stand in place already.
void resumeCell(uint lane, uint base, uint open) {
    uint planes = raw[base + 1u] & 0xffffu, corners = raw[base + 1u] >> 16;
    for (uint p = lane; p < planes; p += LANES) {
        uint id = raw[base + 2u + p];
        if (id < BOX_BASE) setPlane(p, neighborOf(id));
    }
    corner_top = corners;
    plane_count = planes;
    sync();
    for (uint t = lane; t < corners; t += LANES) {
        uint word = raw[base + 2u + RAW_PLANES + t];
        makeCorner(t, word & 0xffu, (word >> 8) & 0xffu, word >> 16);
    }
    sync();
    if (lane < open) {
        uint id = raw[base + RAW_OPEN + lane];
        list_site[lane] = id;
        list_key[lane] = keyOf(vec3(sites[id].xyz - site));
    }
    if (lane == 0u) list_count = open;
    sync();
}

// Planes by their sites' ids, corners by the places of their planes: nothing that follows depends on how a cell was cut. Cells
// that only the largest kernel can hold keep their own order, which is that of one way of cutting only.
#define IN_ORDER (PLANES <= 256)

// Which planes bound the cell, in rim_squares, and their places among these, in rim_sum.
void placePlanes(uint lane) {
    for (uint t = lane; t < corner_top; t += LANES) {
        uvec2 planes = corner_planes[t];
        if (planes.y < GONE) {
            rim_squares[planes.x & 0xffffu] = 1;
            rim_squares[planes.x >> 16] = 1;
            rim_squares[planes.y] = 1;
        }
    }
    sync();
    for (uint p = lane; p < plane_count; p += LANES) {
        uint place = IN_ORDER ? 0u : p;
        for (uint q = 0u; q < plane_count && IN_ORDER; q++)
            place += rim_squares[q] != 0 && uint(plane_d[q].w) < uint(plane_d[p].w) ? 1u : 0u;
        rim_sum[p] = int(place);
    }
    sync();
}

uvec3 placesOf(uvec2 planes) {
    uvec3 p = uvec3(rim_sum[planes.x & 0xffffu], rim_sum[planes.x >> 16], rim_sum[planes.y & ~GONE]);
    bool first = p.x < p.y && p.x < p.z, second = !first && p.y < p.z;
    return first ? p : (second ? p.yzx : p.zxy);
}

// What corners are put in order by, in `slots`.
void keyCorners(uint lane) {
    for (uint t = lane; t < corner_top; t += LANES) {
        uvec3 p = placesOf(corner_planes[t]);
        slots[t] = corner_planes[t].y >= GONE ? NO_INDEX : (IN_ORDER ? (p.x << 16) | (p.y << 8) | p.z : t);
    }
    sync();
}

void writeCorner(uint first, uint place, uvec3 p) {
#ifdef WIDE_TRIPLES
    raw[first + 2u * place] = p.x | (p.y << 16);
    raw[first + 2u * place + 1u] = p.z;
#else
    raw[first + place] = p.x | (p.y << 8) | (p.z << 16);
#endif
}

// A lane's corners stand in a row.
void writeCorners(uint lane, uint first) {
    uint live = 0u, turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k;
        if (onCorner(t) && slots[min(t, CORNERS - 1u)] != NO_INDEX) live++;
    }
    uint rank = sumBefore(lane, live);
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k, key = onCorner(t) ? slots[min(t, CORNERS - 1u)] : NO_INDEX, place = IN_ORDER ? 0u : rank;
        for (uint u = 0u; u < corner_top && IN_ORDER; u++) place += slots[u] < key ? 1u : 0u;
        if (key != NO_INDEX) writeCorner(first, place, placesOf(corner_planes[t]));
        rank += key != NO_INDEX ? 1u : 0u;
    }
}

uint writePlanes(uint lane, uint first) {
    uint bounding = 0u;
    for (uint p = 0u; p < plane_count && IN_ORDER; p++) bounding += rim_squares[p] != 0 ? 1u : 0u;
    for (uint p = lane; p < plane_count; p += LANES) {
        bool bounds = rim_squares[p] != 0;
        if (bounds || !IN_ORDER) raw[first + uint(rim_sum[p])] = bounds ? uint(plane_d[p].w) : NO_INDEX;
    }
    return IN_ORDER ? bounding : plane_count;
}

void writeCell(uint lane, uint group) {
#ifdef WIDE_TRIPLES
    uint base = raw_base + group * (2u + PLANES + 2u * CORNERS);
#else
    uint base = raw_base + self * RAW_WORDS;
#endif
    placePlanes(lane);
    keyCorners(lane);
    writeCorners(lane, base + 2u + PLANES);
    uint planes = writePlanes(lane, base + 2u);
    if (lane == 0u) {
        cell_raw[self] = uvec2(base, size_class);
        raw[base] = status;
        raw[base + 1u] = planes | (lane_sum[LANES - 1] << 16);
        if (status == CELL_OVERFLOW) {
            uint at = atomicAdd(counts[COUNT_EXACT_SMALL + size_class + 1u], 1u);
            if (at < next_capacity) queue[uint(box_high.w) + at] = self;
        }
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    bool queued = cell_count == NO_INDEX;
    if (queued && group >= counts[COUNT_EXACT_SMALL + size_class]) return; // of a grid in rows
    if (counts[STATUS_FAILED] != 0u || (!queued && group >= min(cell_count, counts[COUNT_SITES]))) return;
    self = queued ? queue[uint(box_low.w) + group] : group;
    site = sites[self].xyz;
    startFromBox(lane);
    uint left = queued && size_class == 0u ? raw[self * RAW_WORDS] : 0u;
    bool resumed = (left & 0xffu) == CELL_OPEN;
    if (resumed) resumeCell(lane, self * RAW_WORDS, left >> 8);
    searchCell(lane, resumed);
    writeCell(lane, group);
}
