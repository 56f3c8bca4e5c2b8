// Box Cutting (the paper, section 3) in integers: one workgroup builds one cell, from the box inwards, near to far, until
// the next site is further than twice the furthest corner. Every answer that fp32 leaves open is an integer's sign.
//
// Cutting by e removes corners; what they leave is a disk on the cell's surface whose rim visits every plane at most once.
// Each removed corner (a, b, c) adds c - b style differences to its planes, inner edges cancel in pairs, and a rim plane is
// left with next - prev and next^2 - prev^2: both neighbors along the rim follow without a walk, and each rim plane p makes
// its new corner (p, next, e) on its own.
//
// The order of cuts does not change the cell, only the work: bisectors that remove some corner for certain come first, near
// to far. Those that touch only corners in question wait until the end, when most such corners are gone: of sites on a
// sphere around another one, say, all bisectors all but meet in the center, until the center's own site cuts it off.
//
// PLANES and CORNERS size the store; a cell that outgrows it, or its loop turns, is queued for the next larger kernel.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

#ifndef LANES
#define LANES 64
#define PLANES 64
#define CORNERS 112
#endif
#define SUM_STEPS (LANES > 256 ? 5 : (LANES > 64 ? 4 : 3)) /* powers of four up to LANES */
#define PLANE_TURNS ((PLANES + LANES - 1) / LANES)
#define SIEVE_CORNERS 160 /* with more corners a look at all of them costs more than the test it saves */
#define LIST_SIZE (LANES > 512 ? 2 * LANES : 1024)
#define WAITING 0x80000000u /* in a key: touches only corners in question */

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
#include "lib/bin_lines.glsl"

// Bins are searched in two cubes around the home bin, then all that is left.
int ringsOf(uint cube) { return cube == 0u ? 1 : 3; }
// Of the 65,535 loop turns that Mesa's software device allows; a cell that needs more goes to the next kernel.
const uint kTurnBudget = 56000u;

shared uint list_key[LIST_SIZE];
shared uint list_site[LIST_SIZE];
shared uint lane_sum[LANES];
shared uint line_first[LANES];
shared uint line_end[LANES];
shared uint list_count, best_key, best_site, best_slot, reach_bits, removed_count, open_count;

// The same for all lanes.
uint self, corner_top, plane_count, status, budget;
ivec3 site, home;

void spend(uint turns) { budget -= min(budget, turns); }
uint cornerTurns() { return corner_top / LANES + 1u; }
bool onCorner(uint t) { return t < corner_top; }

void startFromBox(uint lane) {
    for (uint p = lane; p < PLANES; p += LANES) {
        rim_sum[p] = 0;
        rim_squares[p] = 0;
    }
    if (lane < 6u) {
        uint axis = lane >> 1;
        bool high = (lane & 1u) != 0u;
        ivec3 d = ivec3(0);
        d[axis] = high ? 1 : -1;
        int distance = high ? box_high[axis] - site[axis] : site[axis] - box_low[axis];
        setPlane(lane, d, BOX_BASE + lane, int64_t(2 * distance));
    }
    if (lane == 0u) {
        reach_bits = floatBitsToUint(1e30);
        list_count = 0u;
    }
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

void setNeighbor(uint p, uint id) {
    ivec3 d = sites[id].xyz - site;
    setPlane(p, d, id, int64_t(d.x) * int64_t(d.x) + int64_t(d.y) * int64_t(d.y) + int64_t(d.z) * int64_t(d.z));
}

void measureReach(uint lane) {
    if (lane == 0u) reach_bits = 0u;
    sync();
    uint reach = 0u, turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        vec3 w = corner_place[min(k * LANES + lane, corner_top - 1u)].xyz;
        reach = max(reach, floatBitsToUint(dot(w, w) * 1.0001));
    }
    atomicMax(reach_bits, reach);
    sync();
    spend(turns);
}

// Sum over the lanes before this one; lane_sum holds the sums with this one.
uint sumBefore(uint lane, uint value) {
    lane_sum[lane] = value;
    sync();
    // Four-way: half the steps of the usual doubling, each with three terms.
    [[unroll]] for (uint k = 0u; k < SUM_STEPS; k++) {
        uint step = 1u << (2u * k);
        uint left = lane >= step ? lane_sum[lane - step] : 0u;
        left += lane >= 2u * step ? lane_sum[lane - 2u * step] : 0u;
        left += lane >= 3u * step ? lane_sum[lane - 3u * step] : 0u;
        sync();
        lane_sum[lane] += left;
        sync();
    }
    return lane_sum[lane] - value;
}

// The key under which a candidate is listed, a candidate a lane. The cell only shrinks, so NO_INDEX is for good.
uint keyOf(vec3 d) {
    uint looked = corner_top <= SIEVE_CORNERS ? corner_top : 0u;
    float square = dot(d, d), size = length(d), possible = looked == 0u ? square : 0.0, certain = possible;
    for (uint k = 0u; k < looked; k++) {
        vec4 c = corner_place[k];
        float q = dot(d, c.xyz), slack = size * c.w;
        possible = max(possible, q + slack);
        certain = max(certain, q - slack);
    }
    bool waits = looked != 0u && certain <= square * (1.0 + kPlaceError);
    uint key = floatBitsToUint(square) | (waits ? WAITING : 0u);
    return possible >= square * (1.0 - kPlaceError) ? key : NO_INDEX;
}

// After every cut where it is cheap, now and then where it is not.
void sieveList(uint lane) {
    uint total = list_count, turns = (total / LANES + 1u) * (corner_top + 1u);
    if (corner_top > SIEVE_CORNERS || (turns > 256u && plane_count % 8u != 0u)) return;
    for (uint k = lane; k < total; k += LANES) {
        if (list_key[k] != NO_INDEX) list_key[k] = keyOf(vec3(sites[list_site[k]].xyz - site));
    }
    spend(turns);
    sync();
}

// Finds in the next LANES lines of a cube, a line a lane, the bins whose sites may cut a corner; returns how many sites.
uint openLines(uint lane, uint first_line, int cube, bool all_bins) {
    int width = all_bins ? bins.y : 2 * cube + 1, line = int(first_line + lane);
    int y = all_bins ? line % width : home.y + line % width - cube, z = all_bins ? line / width : home.z + line / width - cube;
    bool inside = y >= 0 && y < bins.y && z >= 0 && z < bins.z && line < (all_bins ? bins.y * bins.z : width * width);
    vec2 span_y = spanOf(y, site.y, box_low.y), span_z = spanOf(z, site.z, box_low.z), part = vec2(1e30, -1e30);
    uint looked = corner_top <= SIEVE_CORNERS ? corner_top : 0u;
    for (uint k = 0u; k < looked; k++) widenByBall(part, corner_place[k].xyz, corner_place[k].w, span_y, span_z);
    spend(looked + 1u);
    ivec2 reached = looked == 0u ? ivec2(0, bins.x - 1) : binsOfPart(part, site.x);
    int x0 = all_bins ? reached.x : max(reached.x, home.x - cube), x1 = all_bins ? reached.y : min(reached.y, home.x + cube);
    bool any_ = inside && x0 <= x1;
    uint row = any_ ? uint((z * bins.y + y) * bins.x) : 0u;
    uint begin = any_ ? bin_start[row + uint(x0)] : 0u, end = any_ ? bin_start[row + uint(x1) + 1u] : 0u;
    line_first[lane] = begin;
    sumBefore(lane, end - begin);
    line_end[lane] = lane_sum[lane];
    sync();
    return line_end[LANES - 1];
}

// Lists the sites from the opened lines, from the k-th on, that may still cut; `seen` is the cube that was searched before.
void listSites(uint lane, uint k, uint total, int seen) {
    uint low = 0u, high = LANES - 1u;
    for (uint step = 0u; step < 11u && low < high; step++) {
        uint middle = (low + high) / 2u;
        if (line_end[middle] > k) high = middle;
        else low = middle + 1u;
    }
    bool is_site = k < total;
    uint before = low > 0u ? line_end[low - 1u] : 0u;
    ivec4 q = bin_sites[is_site ? line_first[low] + k - before : 0u];
    vec3 d = vec3(q.xyz - site);
    ivec3 away = abs(binOf(q.xyz) - home);
    bool fresh = is_site && uint(q.w) != self && max(away.x, max(away.y, away.z)) > seen;
    uint key = keyOf(d);
    if (fresh && key != NO_INDEX && dot(d, d) <= uintBitsToFloat(reach_bits)) {
        uint s = atomicAdd(list_count, 1u);
        list_key[s] = key;
        list_site[s] = uint(q.w);
    }
    spend(12u + min(corner_top, SIEVE_CORNERS));
    sync();
}

// Strikes the nearest candidate off the list, by (distance, id); false where there is none but those that wait.
bool takeNearest(uint lane, bool waiting_too) {
    if (lane == 0u) {
        best_key = NO_INDEX;
        best_site = NO_INDEX;
        removed_count = 0u;
        open_count = 0u;
    }
    sync();
    uint key = NO_INDEX, id = NO_INDEX, slot = 0u, total = list_count;
    for (uint s = lane; s < total; s += LANES) {
        uint k = list_key[s];
        k = (k & WAITING) != 0u && !waiting_too ? NO_INDEX : k;
        bool better = k < key || (k == key && k != NO_INDEX && list_site[s] < id);
        key = better ? k : key;
        id = better ? list_site[s] : id;
        slot = better ? s : slot;
    }
    atomicMin(best_key, key);
    sync();
    if (key == best_key) atomicMin(best_site, id);
    sync();
    if (key != NO_INDEX && key == best_key && id == best_site) {
        best_slot = slot;
        list_key[slot] = NO_INDEX;
    }
    sync();
    spend(total / LANES + 2u);
    return best_key != NO_INDEX;
}

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
        bool outside = q - slack > square * (1.0 + kPlaceError), inside = q + slack < square * (1.0 - kPlaceError);
        if (onCorner(t) && outside) removeCorner(t);
        if (onCorner(t) && !outside && !inside) slots[atomicAdd(open_count, 1u)] = t;
    }
    spend(turns);
    sync();
}

bool removes(Plane e, uint t) {
    uvec2 planes = corner_planes[t];
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
        ivec3 d = sites[id].xyz - site;
        Plane e = Plane(d, id, int64_t(d.x) * int64_t(d.x) + int64_t(d.y) * int64_t(d.y) + int64_t(d.z) * int64_t(d.z));
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
}

void cutByListed(uint lane, bool waiting_too) {
    if (waiting_too) sieveWaiting(lane);
    for (uint step = 0u; step < 16384u && budget > 0u && status == CELL_OK; step++) {
        if (!takeNearest(lane, waiting_too)) break;
        uint id = best_site, slot = best_slot;
        ivec3 d = sites[id].xyz - site;
        removeCertain(lane, vec3(d));
        bool certain = removed_count != 0u, open = open_count != 0u;
        sync();
        if (!certain && open && !waiting_too && lane == 0u) list_key[slot] = floatBitsToUint(dot(vec3(d), vec3(d))) | WAITING;
        if (certain || (open && waiting_too)) {
            int64_t r = int64_t(d.x) * int64_t(d.x) + int64_t(d.y) * int64_t(d.y) + int64_t(d.z) * int64_t(d.z);
            removeExact(lane, Plane(d, id, r));
            if (removed_count != 0u) {
                if (plane_count >= PLANES - 1u) status = CELL_OVERFLOW;
                if (lane == 0u) setNeighbor(min(plane_count, PLANES - 1u), id);
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

// Closes the gaps that struck candidates leave. A turn never writes beyond what it has read.
void packList(uint lane) {
    uint total = list_count;
    sync();
    if (lane == 0u) list_count = 0u;
    sync();
    for (uint first = 0u; first < total; first += LANES) {
        uint s = min(first + lane, total - 1u), key = list_key[s], id = list_site[s];
        sync();
        if (first + lane < total && key != NO_INDEX) {
            uint to = atomicAdd(list_count, 1u);
            list_key[to] = key;
            list_site[to] = id;
        }
        sync();
    }
    spend(total / LANES + 1u);
}

void cutCell(uint lane, bool searched_before) {
    uint cube = 0u, next_line = 0u, done = 0u, total = 0u;
    bool last = searched_before, finished = false;
    for (uint turn = 0u; turn < 4096u && !finished; turn++) {
        bool all_bins = cube == 2u;
        int width = 2 * ringsOf(cube) + 1;
        uint lines = all_bins ? uint(bins.y * bins.z) : uint(width * width);
        if (done >= total && next_line < lines && !last) {
            total = openLines(lane, next_line, ringsOf(cube), all_bins);
            next_line += LANES;
            done = 0u;
        }
        for (uint guard = 0u; guard < 4096u && done < total && list_count + LANES <= LIST_SIZE && budget > 0u; guard++) {
            sync();
            listSites(lane, done + lane, total, cube == 0u ? -1 : ringsOf(cube - 1u));
            done += LANES;
        }
        bool full = list_count + LANES > LIST_SIZE;
        sync();
        cutByListed(lane, last || full);
        packList(lane);
        bool searched = done >= total && next_line >= lines;
        if (last) finished = true;
        if (searched && !last) {
            float clear = ringDistance(site, home, ringsOf(cube));
            last = all_bins || clear * clear * 0.9999 > uintBitsToFloat(reach_bits);
            finished = last && list_count == 0u;
            cube = min(cube + 1u, 2u);
            next_line = 0u;
            done = 0u;
            total = 0u;
        }
        if (budget == 0u) status = CELL_OVERFLOW;
        finished = finished || status != CELL_OK;
        sync();
    }
    if (!finished) status = CELL_OVERFLOW;
}

// Goes on with what the filtered kernel left: all is cut but for a few sites. The walls of the box stand in place already.
void resumeCell(uint lane, uint base, uint open) {
    uint planes = raw[base + 1u] & 0xffffu, corners = raw[base + 1u] >> 16;
    for (uint p = lane; p < planes; p += LANES) {
        uint id = raw[base + 2u + p];
        if (id < BOX_BASE) setNeighbor(p, id);
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

void writeCell(uint lane, uint group) {
#ifdef WIDE_TRIPLES
    uint base = raw_base + group * (2u + PLANES + 2u * CORNERS);
#else
    uint base = raw_base + self * RAW_WORDS;
#endif
    uint live = 0u, turns = cornerTurns();
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k;
        if (onCorner(t) && corner_planes[min(t, CORNERS - 1u)].y < GONE) live++;
    }
    uint rank = sumBefore(lane, live);
    for (uint k = 0u; k < turns; k++) {
        uint t = lane * turns + k;
        uvec2 planes = corner_planes[min(t, CORNERS - 1u)];
        if (onCorner(t) && planes.y < GONE) {
            rim_squares[planes.x & 0xffffu] = 1; // this plane still bounds the cell
            rim_squares[planes.x >> 16] = 1;
            rim_squares[planes.y] = 1;
#ifdef WIDE_TRIPLES
            raw[base + 2u + PLANES + 2u * rank] = planes.x;
            raw[base + 3u + PLANES + 2u * rank] = planes.y;
#else
            raw[base + 2u + PLANES + rank] = (planes.x & 0xffu) | ((planes.x >> 8) & 0xff00u) | (planes.y << 16);
#endif
            rank++;
        }
    }
    sync();
    for (uint p = lane; p < PLANES; p += LANES) raw[base + 2u + p] = rim_squares[p] != 0 ? uint(plane_d[p].w) : NO_INDEX;
    if (lane == 0u) {
        cell_raw[self] = uvec2(base, size_class);
        raw[base] = status;
        raw[base + 1u] = plane_count | (lane_sum[LANES - 1] << 16);
        if (status != CELL_OK) {
            uint at = atomicAdd(counts[COUNT_EXACT_SMALL + size_class + 1u], 1u);
            if (at < next_capacity) queue[uint(box_high.w) + at] = self;
        }
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    bool queued = cell_count == NO_INDEX;
    if (counts[STATUS_FAILED] != 0u || (!queued && group >= min(cell_count, counts[COUNT_SITES]))) return;
    self = queued ? queue[uint(box_low.w) + group] : group;
    site = sites[self].xyz;
    home = binOf(site);
    status = CELL_OK;
    budget = kTurnBudget;
    startFromBox(lane);
    uint left = queued && size_class == 0u ? raw[self * RAW_WORDS] : 0u;
    bool resumed = (left & 0xffu) == CELL_OPEN;
    if (resumed) resumeCell(lane, self * RAW_WORDS, left >> 8);
    cutCell(lane, resumed);
    writeCell(lane, group);
}
