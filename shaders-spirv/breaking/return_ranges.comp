// Returns ranges to the pools, a workgroup a pool: they are sorted by where they begin and merged with the list of free ranges,
// and what touches becomes one. What becomes free is the union of both, so that the order in which ranges were returned makes
// no difference, not even where some overlap, which is a bug and noted.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/pool.h"

#ifndef LANES
#define LANES 8u
#endif
#define DIGIT_BITS 5
layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, PoolShare, returned);
UPDATES(2, PoolHeader, headers);
// Lanes read what others have written.
layout(set = 0, binding = 3, std430) coherent buffer free_block { uvec2 free_ranges[]; }; // begin, size
layout(set = 0, binding = 4, std430) coherent buffer order_block { uint order[]; };
layout(set = 0, binding = 5, std430) coherent buffer sorted_block { uvec2 sorted[]; }; // begin, end
layout(push_constant) uniform Push {
    uint returned_count; // of `counts`
    uint returned_room;
    uint range_room;
};
#include "lib/pool_table.glsl"

shared uint amiss;      // bits of a pool's status
shared uint ends[LANES];
shared uint united;     // elements that are free or returned
shared uint twice;      // elements that are so more than once
shared uint kept;       // elements that the new list holds

void sync() { barrier(); }
#include "lib/sum_before.glsl"

#define pool gl_WorkGroupID.x
void syncBuffers() {
    memoryBarrierBuffer();
    barrier();
}

uint digitOf(uint entry, uint shift) { return (returned[entry].begin[pool] >> shift) & ((1u << DIGIT_BITS) - 1u); }
#include "lib/group_sort.glsl"

struct Run {
    uint first, end;
};
Run runOf(uint lane, uint n) {
    uint each = (n + LANES - 1u) / LANES, first = min(lane * each, n);
    return Run(first, min(first + each, n));
}

bool isInside(uint entry) {
    uint capacity = headers[pool].capacity, begin = returned[entry].begin[pool], size = returned[entry].size[pool];
    return size == 0u || (size <= capacity && begin <= capacity - size);
}

// Returns how many there are, in `order`.
uint listReturned(uint lane, uint asked) {
    Run run = runOf(lane, asked);
    uint base = 2u * pool * returned_room, found = 0u;
    for (uint k = run.first; k < run.end; k++) {
        bool inside = isInside(k);
        if (!inside) atomicOr(amiss, POOL_RETURNED_OUTSIDE);
        found += inside && returned[k].size[pool] != 0u ? 1u : 0u;
    }
    uint at = base + sumBefore(lane, found), total = lane_sum[LANES - 1u];
    for (uint k = run.first; k < run.end; k++)
        if (isInside(k) && returned[k].size[pool] != 0u) order[at++] = k;
    syncBuffers();
    return total;
}

void sortReturned(uint lane, uint n) {
    uint base = 2u * pool * returned_room, from = base, to = base + returned_room;
    uint bits = uint(findMSB(headers[pool].capacity) + 1);
    for (uint shift = 0u; shift < bits; shift += DIGIT_BITS) {
        sortBy(shift, n, from, to);
        uint next = from;
        from = to;
        to = next;
    }
    for (uint k = lane; k < n; k += LANES) {
        uint entry = order[from + k], begin = returned[entry].begin[pool];
        sorted[pool * returned_room + k] = uvec2(begin, begin + returned[entry].size[pool]);
    }
    syncBuffers();
}

// A place in both lists as one, in order of begins.
struct Walk {
    uint free, returned; // how many of either come before
};

// The way of a merge splits where the next of one list comes behind all that has been taken of the other.
Walk walkFrom(uint at, PoolTable table, uint n) {
    uint low = at > n ? at - n : 0u, high = min(at, table.count);
    for (uint turn = 0u; turn < 32u && low < high; turn++) {
        uint middle = (low + high) / 2u;
        bool before = free_ranges[table.from + middle].x <= sorted[pool * returned_room + at - 1u - middle].x;
        low = before ? middle + 1u : low;
        high = before ? high : middle;
    }
    return Walk(low, at - low);
}

// Begin and end.
uvec2 next(inout Walk walk, PoolTable table, uint n) {
    uvec2 free = free_ranges[table.from + min(walk.free, range_room - 1u)];
    uvec2 back = sorted[pool * returned_room + min(walk.returned, returned_room - 1u)];
    bool is_free = walk.free < table.count && (walk.returned >= n || free.x <= back.x);
    walk.free += is_free ? 1u : 0u;
    walk.returned += is_free ? 0u : 1u;
    return is_free ? uvec2(free.x, free.x + free.y) : back;
}

// How far the ranges of a run reach is counted from 1, so that 0 is nothing: a range that begins there or beyond touches none.
uint reachBefore(uint lane, Run run, PoolTable table, uint n) {
    Walk walk = walkFrom(run.first, table, n);
    uint own = 0u, before = 0u;
    for (uint k = run.first; k < run.end; k++) own = max(own, next(walk, table, n).y + 1u);
    ends[lane] = own;
    sync();
    for (uint other = 0u; other < lane; other++) before = max(before, ends[other]);
    return before;
}

uint startsIn(Run run, uint reach, PoolTable table, uint n) {
    Walk walk = walkFrom(run.first, table, n);
    uint starts = 0u;
    for (uint k = run.first; k < run.end; k++) {
        uvec2 range = next(walk, table, n);
        starts += range.x >= reach ? 1u : 0u;
        reach = max(reach, range.y + 1u);
    }
    return starts;
}

void endRange(uint at, uint reach, PoolTable table) {
    if (at < range_room) free_ranges[table.to + at].y = reach - 1u;
}

// Where ranges of the new list begin, and where those before them end.
void writeRun(Run run, uint at, uint reach, PoolTable table, uint n) {
    Walk walk = walkFrom(run.first, table, n);
    uint more = 0u, again = 0u;
    for (uint k = run.first; k < run.end; k++) {
        uvec2 range = next(walk, table, n);
        if (range.x >= reach) {
            if (at > 0u) endRange(at - 1u, reach, table);
            if (at < range_room) free_ranges[table.to + at].x = range.x;
            at++;
        }
        uint added = range.y + 1u - min(max(reach, range.x + 1u), range.y + 1u);
        more += added;
        again += range.y - range.x - added;
        reach = max(reach, range.y + 1u);
    }
    if (run.end == table.count + n && run.first < run.end) endRange(at - 1u, reach, table);
    atomicAdd(united, more);
    atomicAdd(twice, again);
}

// Returns how many ranges are free.
uint merge(uint lane, PoolTable table, uint n) {
    Run run = runOf(lane, table.count + n);
    uint reach = reachBefore(lane, run, table, n);
    uint at = sumBefore(lane, startsIn(run, reach, table, n)), total = lane_sum[LANES - 1u];
    writeRun(run, at, reach, table, n);
    syncBuffers();
    uint held = min(total, range_room), sum = 0u;
    for (uint k = lane; k < held; k += LANES) {
        uint size = free_ranges[table.to + k].y - free_ranges[table.to + k].x;
        free_ranges[table.to + k].y = size;
        sum += size;
    }
    atomicAdd(kept, sum);
    sync();
    return total;
}

void noteMerged(uint total) {
    headers[pool].free_ranges = min(total, range_room);
    headers[pool].side ^= 1u;
    headers[pool].in_use = headers[pool].capacity - kept;
    headers[pool].returned_twice += twice;
    headers[pool].lost += united - kept;
    if (twice != 0u) amiss |= POOL_RETURNED_TWICE;
    if (total > range_room) amiss |= POOL_TABLE_FULL;
}

void main() {
    uint lane = gl_LocalInvocationID.x, asked = counts[returned_count];
    if (asked == 0u) return;
    if (lane == 0u) {
        amiss = asked > returned_room ? POOL_LIST_FULL : 0u;
        united = 0u;
        twice = 0u;
        kept = 0u;
    }
    sync();
    uint n = listReturned(lane, min(asked, returned_room)), total = 0u;
    if (n != 0u) {
        sortReturned(lane, n);
        total = merge(lane, tableOf(pool), n);
    }
    if (lane == 0u && n != 0u) noteMerged(total);
    if (lane == 0u) headers[pool].status |= amiss;
}
