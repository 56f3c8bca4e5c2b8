// Box Cutting (the paper, section 3) in integers: one workgroup builds one cell, from the box inwards, near to far, until
// the next site is further than twice the furthest corner. Nothing is rounded but the radius that bounds the search.
//
// A cell is planes and corners; a corner is a triple of planes in the order in which their normals make a positive volume
// (the dual triangle). Cutting by e removes corners; what they leave is a disk on the cell's surface whose rim visits every
// plane at most once. Each removed corner (a, b, c) adds c - b style differences to its planes, inner edges cancel in
// pairs, and a rim plane is left with next - prev and next^2 - prev^2: both neighbors along the rim follow without a walk,
// and each rim plane p makes its new corner (p, next, e) on its own.
//
// PLANES and CORNERS size the store; a cell that outgrows it is queued for the next larger kernel.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "lib/kernel.glsl"
#include "lib/exact_cut.glsl"

#ifndef LANES
#define LANES 64
#define PLANES 64
#define CORNERS 112
#endif
#define PLANE_TURNS ((PLANES + LANES - 1) / LANES)
#define CORNER_TURNS ((CORNERS + LANES - 1) / LANES)
#define SIEVE_CORNERS 160 /* with more corners a look at all of them costs more than the exact test it saves */
#define LIST_SIZE 1024
#define LIST_TURNS (LIST_SIZE / LANES)
#define NEAR_RINGS 6
#define NO_CORNER 0xffffffffu

// Places are quotients of exact integers: a few roundings each, then three products and sums in a test. Unit roundoff 2^-23.
const float kPlaceError = 16.0 / 8388608.0;

layout(local_size_x = LANES) in;
UPDATES(0, uint, counts);
READS(1, ivec4, sites);     // by id
READS(2, uint, bin_start);  // grid of bins, x fastest
READS(3, ivec4, bin_sites); // position and id, bin by bin
UPDATES(4, uint, queue);    // cells of this kernel, then of the next larger one
WRITES(5, uint, raw);
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

// The cell while it is cut: in shared memory, or for the larger ones in a buffer, a store a workgroup.
#ifdef GLOBAL_STORE
struct CellStore {
    ivec4 plane_d[PLANES];
    vec4 corner_place[CORNERS];
    uvec2 plane_r[PLANES];
    uvec2 corner_planes[CORNERS];
    int rim_sum[PLANES];
    int rim_squares[PLANES];
    uint free_slots[CORNERS];
    uint corner_store[16 * CORNERS];
};
layout(set = 0, binding = 7, std430) coherent buffer stores_block { CellStore stores[]; };
#define plane_d stores[flatGroup()].plane_d
#define corner_place stores[flatGroup()].corner_place
#define plane_r stores[flatGroup()].plane_r
#define corner_planes stores[flatGroup()].corner_planes
#define rim_sum stores[flatGroup()].rim_sum
#define rim_squares stores[flatGroup()].rim_squares
#define free_slots stores[flatGroup()].free_slots
#define corner_store stores[flatGroup()].corner_store
#else
UPDATES(7, uint, store);
shared ivec4 plane_d[PLANES];        // normal, id
shared vec4 corner_place[CORNERS];   // w in fp32 and a bound of its error; zero where free
shared uvec2 plane_r[PLANES];
shared uvec2 corner_planes[CORNERS]; // a | b << 16, c; NO_CORNER when free
shared int rim_sum[PLANES];
shared int rim_squares[PLANES];
shared uint free_slots[CORNERS];
shared uint corner_store[16 * CORNERS]; // moment and volume
#endif

uint loadWord(uint t, uint k) { return corner_store[k * CORNERS + t]; }
void saveWord(uint t, uint k, uint v) { corner_store[k * CORNERS + t] = v; }

void sync() {
#ifdef GLOBAL_STORE
    memoryBarrierBuffer();
#endif
    barrier();
}

shared uint list_key[LIST_SIZE];
shared uint list_site[LIST_SIZE];
shared uint scan_sum[LANES];
shared uint list_count, best_key, best_slot, reach_bits, removed_count, corner_top;

Wide128 loadWide(uint t, uint k) {
    uint64_t lo = uint64_t(loadWord(t, k)) | (uint64_t(loadWord(t, k + 1u)) << 32);
    uint64_t hi = uint64_t(loadWord(t, k + 2u)) | (uint64_t(loadWord(t, k + 3u)) << 32);
    return Wide128(lo, int64_t(hi));
}

void saveWide(uint t, uint k, Wide128 v) {
    saveWord(t, k, uint(v.lo));
    saveWord(t, k + 1u, uint(v.lo >> 32));
    saveWord(t, k + 2u, uint(uint64_t(v.hi)));
    saveWord(t, k + 3u, uint(uint64_t(v.hi) >> 32));
}

Corner loadCorner(uint t) {
    Corner c;
    c.moment[0] = loadWide(t, 0u);
    c.moment[1] = loadWide(t, 4u);
    c.moment[2] = loadWide(t, 8u);
    c.volume = loadWide(t, 12u);
    return c;
}

Plane planeAt(uint p) {
    ivec4 d = plane_d[p];
    uvec2 r = plane_r[p];
    return Plane(d.xyz, uint(d.w), int64_t(uint64_t(r.x) | (uint64_t(r.y) << 32)));
}

void setPlane(uint p, ivec3 d, uint id, int64_t r) {
    plane_d[p] = ivec4(d, int(id));
    plane_r[p] = uvec2(uint(uint64_t(r)), uint(uint64_t(r) >> 32));
}

void makeCorner(uint t, uint a, uint b, uint c) {
    Corner corner = cornerOf(planeAt(a), planeAt(b), planeAt(c));
    corner_planes[t] = uvec2(a | (b << 16), c);
    saveWide(t, 0u, corner.moment[0]);
    saveWide(t, 4u, corner.moment[1]);
    saveWide(t, 8u, corner.moment[2]);
    saveWide(t, 12u, corner.volume);
    vec3 w = placeOf(corner);
    corner_place[t] = vec4(w, kPlaceError * (abs(w.x) + abs(w.y) + abs(w.z)));
    atomicMax(corner_top, t + 1u);
}

void startFromBox(uint lane, ivec3 site) {
    if (lane < 6u) {
        uint axis = lane >> 1;
        bool high = (lane & 1u) != 0u;
        ivec3 d = ivec3(0);
        d[axis] = high ? 1 : -1;
        int distance = high ? box_high[axis] - site[axis] : site[axis] - box_low[axis];
        setPlane(lane, d, BOX_BASE + lane, int64_t(2 * distance));
    }
    sync();
    if (lane < 8u) {
        uint x = lane & 1u, y = 2u + ((lane >> 1) & 1u), z = 4u + (lane >> 2);
        bool odd = ((lane ^ (lane >> 1) ^ (lane >> 2)) & 1u) != 0u;
        makeCorner(lane, x, odd ? y : z, odd ? z : y);
    }
}

// Corners lie in the lowest slots: a cut frees as many as it removes and needs at most two more.
uint turnsInUse() { return min(uint(CORNER_TURNS), corner_top / LANES + 1u); }

void measureReach(uint lane) {
    uint reach = 0u, turns = turnsInUse();
    for (uint k = 0u; k < turns; k++) {
        uint t = k * LANES + lane;
        vec3 w = corner_place[min(t, CORNERS - 1u)].xyz;
        reach = max(reach, floatBitsToUint(dot(w, w) * 1.0001));
    }
    atomicMax(reach_bits, reach);
}

// Prefix sum over lanes of two 16-bit counters at once; returns the sum before this lane, scan_sum holds the rest.
uint scanLanes(uint lane, uint value) {
    scan_sum[lane] = value;
    sync();
    // Four-way: half the steps of the usual doubling, each with three terms.
    for (uint step = 1u; step < LANES; step <<= 2) {
        uint left = lane >= step ? scan_sum[lane - step] : 0u;
        left += lane >= 2u * step ? scan_sum[lane - 2u * step] : 0u;
        left += lane >= 3u * step ? scan_sum[lane - 3u * step] : 0u;
        sync();
        scan_sum[lane] += left;
        sync();
    }
    return scan_sum[lane] - value;
}

// Nearest listed candidate, by (distance, place in the list).
void selectNearest(uint lane) {
    if (lane == 0u) {
        best_key = NO_INDEX;
        best_slot = NO_INDEX;
        removed_count = 0u;
    }
    sync();
    uint key = NO_INDEX, slot = NO_INDEX;
    for (uint k = 0u; k * LANES < list_count; k++) {
        uint s = k * LANES + lane;
        uint candidate = s < list_count ? list_key[s] : NO_INDEX;
        slot = candidate < key ? s : slot;
        key = min(key, candidate);
    }
    atomicMin(best_key, key);
    sync();
    if (key == best_key && key != NO_INDEX) atomicMin(best_slot, slot);
    sync();
}

// Marks corners that plane e removes, and adds their differences to the rim sums of their planes.
void removeCorners(uint lane, uint self, Plane e) {
    uint turns = turnsInUse();
    for (uint k = 0u; k < turns; k++) {
        uint t = min(k * LANES + lane, CORNERS - 1u);
        uvec2 planes = corner_planes[t];
        bool live = k * LANES + lane < CORNERS && planes.y != NO_CORNER;
        uint a = live ? planes.x & 0xffffu : 0u, b = live ? planes.x >> 16 : 0u, c = live ? planes.y : 0u;
        int side = sideOf(loadCorner(t), e);
        bool cut = side > 0 || (side == 0 && tieCuts(self, planeAt(a), planeAt(b), planeAt(c), e));
        if (live && cut) {
            atomicAdd(removed_count, 1u);
            corner_planes[t] = uvec2(NO_CORNER);
            corner_place[t] = vec4(0.0);
            int ia = int(a), ib = int(b), ic = int(c);
            atomicAdd(rim_sum[a], ib - ic);
            atomicAdd(rim_sum[b], ic - ia);
            atomicAdd(rim_sum[c], ia - ib);
            atomicAdd(rim_squares[a], ib * ib - ic * ic);
            atomicAdd(rim_squares[b], ic * ic - ia * ia);
            atomicAdd(rim_squares[c], ia * ia - ib * ib);
        }
    }
    sync();
}

// Gives every rim plane a free slot for its new corner; false when the slots are used up.
bool closeRim(uint lane, uint e) {
    uint mine = 0u, turns = turnsInUse();
    for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = lane * PLANE_TURNS + k;
        if (p < PLANES && rim_sum[min(p, PLANES - 1u)] != 0) mine += 1u;
    }
    for (uint k = 0u; k < turns; k++) {
        uint t = k * LANES + lane;
        if (t < CORNERS && corner_planes[min(t, CORNERS - 1u)].y == NO_CORNER) mine += 0x10000u;
    }
    uint before = scanLanes(lane, mine);
    uint total = scan_sum[LANES - 1];
    uint slot = before >> 16, rank = before & 0xffffu;
    for (uint k = 0u; k < turns; k++) {
        uint t = k * LANES + lane;
        if (t < CORNERS && corner_planes[min(t, CORNERS - 1u)].y == NO_CORNER) free_slots[slot++] = t;
    }
    sync();
    bool fits = (total & 0xffffu) <= (total >> 16);
    for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = lane * PLANE_TURNS + k;
        int sum = p < PLANES ? rim_sum[min(p, PLANES - 1u)] : 0;
        if (sum != 0 && fits) {
            int next = (rim_squares[p] / sum + sum) / 2;
            makeCorner(free_slots[rank], p, uint(next), e);
            rank++;
        }
        if (p < PLANES) {
            rim_sum[p] = 0;
            rim_squares[p] = 0;
        }
    }
    return fits;
}

// Whether a bisector may still reach the cell, a candidate a lane: the cell only shrinks, so a no is for good.
bool mayReach(vec3 d) {
    float size = length(d), furthest = 0.0;
    uint looked = corner_top <= SIEVE_CORNERS ? corner_top : 0u;
    for (uint k = 0u; k < looked; k++) furthest = max(furthest, dot(d, corner_place[k].xyz) + size * corner_place[k].w);
    return looked == 0u || furthest >= dot(d, d) * (1.0 - kPlaceError);
}

// Strikes out what can no longer cut, a candidate a lane: most candidates end here, and never cost an exact test.
void sieveList(uint lane, ivec3 site) {
    uint total = corner_top <= SIEVE_CORNERS ? list_count : 0u;
    for (uint k = lane; k < total; k += LANES) {
        uint listed = list_key[k];
        if (listed != NO_INDEX && !mayReach(vec3(sites[list_site[k]].xyz - site))) list_key[k] = NO_INDEX;
    }
    sync();
}

// Lists the sites of one row of bins that may still cut; sites of rings seen before are passed over.
void listRow(uint lane, uint self, ivec3 site, ivec3 home, uint first, uint last, int seen_ring) {
    float reach = uintBitsToFloat(reach_bits);
    uint k = first + lane;
    bool in_row = k < last;
    ivec4 q = bin_sites[in_row ? k : first];
    ivec3 d = q.xyz - site;
    ivec3 away = abs((q.xyz - box_low.xyz) / bins.w - home);
    bool fresh = max(away.x, max(away.y, away.z)) > seen_ring;
    vec3 f = vec3(d);
    float distance = dot(f, f);
    if (in_row && fresh && uint(q.w) != self && distance <= reach && mayReach(f)) {
        uint s = atomicAdd(list_count, 1u);
        list_key[s] = floatBitsToUint(distance);
        list_site[s] = uint(q.w);
    }
}

float ringDistance(ivec3 site, ivec3 home, int ring) {
    float least = 1e30;
    for (int k = 0; k < 3; k++) {
        if (home[k] - ring > 0) least = min(least, float(site[k] - box_low[k] - (home[k] - ring) * bins.w));
        if (home[k] + ring + 1 < bins[k]) least = min(least, float((home[k] + ring + 1) * bins.w - (site[k] - box_low[k])));
    }
    return least;
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = flatGroup();
    bool queued = cell_count == NO_INDEX;
    uint self = queued ? queue[uint(box_low.w) + group] : group;
    bool idle = counts[STATUS_FAILED] != 0u || (!queued && group >= min(cell_count, counts[COUNT_SITES]));
    self = idle ? 0u : self;
    ivec3 site = sites[self].xyz;
    for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = k * LANES + lane;
        if (p < PLANES) {
            rim_sum[p] = 0;
            rim_squares[p] = 0;
        }
    }
    for (uint k = 0u; k < CORNER_TURNS; k++) {
        if (k * LANES + lane < CORNERS) {
            corner_planes[k * LANES + lane] = uvec2(NO_CORNER);
            corner_place[k * LANES + lane] = vec4(0.0);
        }
    }
    if (lane == 0u) {
        reach_bits = 0u;
        list_count = 0u;
        corner_top = 0u;
    }
    sync();
    startFromBox(lane, site);
    sync();
    measureReach(lane);
    sync();

    ivec3 home = min((site - box_low.xyz) / bins.w, bins.xyz - 1);
    int ring = 0, seen_ring = -1;
    uint row = 0u, row_done = 0u, plane_count = 6u, status = CELL_OK;
    bool everything = false, finished = idle;
    for (uint turn = 0u; turn < 4096u && !finished; turn++) {
        // Fill the list: rows of this ring (or, far out, all sites at once), as many as fit.
        int width = 2 * ring + 1;
        uint rows = everything ? 1u : uint(2 * width * width);
        bool room = true;
        for (uint guard = 0u; guard < 16384u && row < rows && room; guard++) {
            int y = home.y + int(row >> 1) % width - ring, z = home.z + int(row >> 1) / width - ring;
            bool whole = abs(y - home.y) == ring || abs(z - home.z) == ring;
            bool right = (row & 1u) != 0u;
            int x0 = whole || !right ? home.x - ring : home.x + ring, x1 = whole ? home.x + ring : x0;
            bool inside = y >= 0 && y < bins.y && z >= 0 && z < bins.z && x1 >= 0 && x0 < bins.x && !(whole && right);
            x0 = max(x0, 0);
            x1 = min(x1, bins.x - 1);
            uint line = inside ? uint((z * bins.y + y) * bins.x) : 0u;
            uint first = inside ? bin_start[line + uint(x0)] : 0u, last = inside ? bin_start[line + uint(x1) + 1u] : 0u;
            first = everything ? 0u : first;
            last = everything ? counts[COUNT_SITES] : last;
            listRow(lane, self, site, home, min(first + row_done, last), last, seen_ring);
            row_done += LANES;
            bool ended = first + row_done >= last;
            row += ended ? 1u : 0u;
            row_done = ended ? 0u : row_done;
            sync();
            room = list_count + LANES <= LIST_SIZE;
            sync();
        }
        // Cut by what is listed, near to far.
        for (uint step = 0u; step < 8192u; step++) {
            selectNearest(lane);
            uint slot = best_slot;
            bool more = slot != NO_INDEX;
            uint id = list_site[min(slot, LIST_SIZE - 1u)];
            sync();
            if (!more) break;
            if (lane == 0u) list_key[slot] = NO_INDEX;
            ivec3 d = sites[id].xyz - site;
            int64_t r = int64_t(d.x) * int64_t(d.x) + int64_t(d.y) * int64_t(d.y) + int64_t(d.z) * int64_t(d.z);
            Plane e = Plane(d, id, r);
            if (lane == 0u) setPlane(min(plane_count, PLANES - 1u), d, id, r);
            if (plane_count >= PLANES - 1u) status = CELL_OVERFLOW;
            removeCorners(lane, self, e);
            bool cuts = removed_count != 0u;
            bool fits = closeRim(lane, plane_count);
            if (cuts && !fits) status = CELL_OVERFLOW;
            plane_count += cuts ? 1u : 0u;
            if (lane == 0u && cuts) reach_bits = 0u;
            sync();
            measureReach(lane);
            sync();
            sieveList(lane, site);
            if (status != CELL_OK) break;
        }
        sync();
        if (lane == 0u) list_count = 0u;
        bool ring_done = row >= rows;
        if (ring_done) {
            float clear = ringDistance(site, home, ring);
            seen_ring = ring;
            finished = everything || clear * clear * 0.9999 > uintBitsToFloat(reach_bits);
            ring++;
            // A shell of many short rows costs more than one look at every site.
            everything = ring > NEAR_RINGS || uint(4 * (2 * ring + 1) * (2 * ring + 1)) > counts[COUNT_SITES] / LANES;
            row = 0u;
        }
        finished = finished || status != CELL_OK;
        sync();
    }
    if (!finished) status = CELL_OVERFLOW;

    uint base = raw_base;
#ifdef WIDE_TRIPLES
    base += group * (2u + PLANES + 2u * CORNERS);
#else
    base += self * RAW_WORDS;
#endif
    if (idle) return;
    uint live = 0u;
    for (uint k = 0u; k < CORNER_TURNS; k++) {
        uint t = lane * CORNER_TURNS + k;
        uvec2 planes = corner_planes[min(t, CORNERS - 1u)];
        if (t < CORNERS && planes.y != NO_CORNER) {
            live++;
            rim_squares[planes.x & 0xffffu] = 1; // this plane still bounds the cell
            rim_squares[planes.x >> 16] = 1;
            rim_squares[planes.y] = 1;
        }
    }
    uint rank = scanLanes(lane, live);
    if (lane == 0u) {
        cell_raw[self] = uvec2(base, size_class);
        raw[base] = status;
        raw[base + 1u] = plane_count | (scan_sum[LANES - 1] << 16);
        if (status != CELL_OK) {
            uint at = atomicAdd(counts[COUNT_EXACT_SMALL + size_class + 1u], 1u);
            if (at < next_capacity) queue[uint(box_high.w) + at] = self;
        }
    }
    for (uint k = 0u; k < PLANE_TURNS; k++) {
        uint p = k * LANES + lane;
        if (p < PLANES) raw[base + 2u + p] = rim_squares[min(p, PLANES - 1u)] != 0 ? uint(plane_d[p].w) : NO_INDEX;
    }
    for (uint k = 0u; k < CORNER_TURNS; k++) {
        uint t = lane * CORNER_TURNS + k;
        uvec2 planes = corner_planes[min(t, CORNERS - 1u)];
        if (t < CORNERS && planes.y != NO_CORNER) {
#ifdef WIDE_TRIPLES
            raw[base + 2u + PLANES + 2u * rank] = planes.x;
            raw[base + 3u + PLANES + 2u * rank] = planes.y;
#else
            raw[base + 2u + PLANES + rank] = (planes.x & 0xffu) | ((planes.x >> 8) & 0xff00u) | (planes.y << 16);
#endif
            rank++;
        }
    }
}
