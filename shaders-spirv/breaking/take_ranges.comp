// Takes ranges from the pools for objects that break, all that an object asks for or nothing: it becomes all of its fragments or
// stays whole. Objects and their requests are served in order, each from the first range that is large enough.
//
// One workgroup serves them, with a lane for each pool: what an object finds depends on all that came before it, and on all pools.
// A tree over each list holds the largest size below every eight nodes. A search looks at eight nodes five times. It has then
// seen what lies beside its path, so a store a level keeps the tree right. A request takes one turn of a loop; a walk along the
// list would take more turns than Mesa's software device allows (shaders-spirv/README.md). The other lanes help to make the
// trees and to pack the lists.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/kernel.glsl"
#include "shared/pool.h"

#ifndef LANES
#define LANES 8u
#endif
layout(local_size_x = LANES) in;
READS(0, uint, counts);
READS(1, uint, requests);    // sizes: of every request, one from each pool
READS(2, uint, owner_start); // first request of every owner, and behind the last
UPDATES(3, PoolHeader, headers);
// Lanes read what others have written.
layout(set = 0, binding = 4, std430) coherent buffer free_block { uvec2 free_ranges[]; }; // begin, size
UPDATES(5, uint, taken_from); // range of the list, by request and pool
WRITES(6, uint, begins);      // by request and pool: NO_INDEX where the owner was refused
WRITES(7, uint, lacking);     // by owner and pool: elements of requests that found no range
layout(push_constant) uniform Push {
    uint owner_count; // of `counts`
    uint owner_room;
    uint request_room;
    uint range_room;
};
#include "lib/pool_table.glsl"

// Largest sizes of a pool's ranges: below every 64 ranges, every 512, and every 4096. Those below every eight lie in the half of
// the table to which the list goes in the end.
#define SQUARES 0u
#define CUBES 512u
#define TOPS 576u
#define TREE 584u
shared uint largest[POOLS * TREE];
shared uint missing[POOLS]; // of the owner that is served
shared uint emptied[POOLS]; // some ranges may be used up

void sync() { barrier(); }
#include "lib/sum_before.glsl"

void syncBuffers() {
    memoryBarrierBuffer();
    barrier();
}

uint sizeAt(uint at, PoolTable table) { return at < table.count ? free_ranges[table.from + at].y : 0u; }

uint eightAt(uint at, PoolTable table) { return 8u * at < table.count ? free_ranges[table.to + at].x : 0u; }

// Sums up one level in the next, as far as searches may look: eights of nodes.
void joinLevel(uint lane, uint level, uint next, uint nodes) {
    for (uint k = lane; k < nodes; k += LANES) {
        uint most = 0u;
        [[unroll]] for (uint child = 0u; child < 8u; child++) most = max(most, largest[level + 8u * k + child]);
        largest[next + k] = most;
    }
    sync();
}

void makeTree(uint lane, uint pool) {
    PoolTable table = tableOf(pool);
    uint root = pool * TREE, eights = (table.count + 7u) / 8u, tops = (table.count + 4095u) / 4096u;
    for (uint k = lane; k < eights; k += LANES) {
        uint most = 0u;
        [[unroll]] for (uint child = 0u; child < 8u; child++) most = max(most, sizeAt(8u * k + child, table));
        free_ranges[table.to + k].x = most;
    }
    if (lane < 8u) largest[root + TOPS + lane] = 0u;
    syncBuffers();
    for (uint k = lane; k < 64u * tops; k += LANES) {
        uint most = 0u;
        [[unroll]] for (uint child = 0u; child < 8u; child++) most = max(most, eightAt(8u * k + child, table));
        largest[root + SQUARES + k] = most;
    }
    sync();
    joinLevel(lane, root + SQUARES, root + CUBES, 8u * tops);
    joinLevel(lane, root + CUBES, root + TOPS, tops);
}

// The first of eight that is large enough, 8 if none is, and the largest of the others.
struct Choice {
    uint at, beside;
};

void weigh(inout Choice choice, uint k, uint here, uint size) {
    bool first = choice.at == 8u && here >= size;
    choice.at = first ? k : choice.at;
    choice.beside = first ? choice.beside : max(choice.beside, here);
}

Choice chooseNode(uint first, uint size) {
    Choice choice = Choice(8u, 0u);
    [[unroll]] for (uint k = 0u; k < 8u; k++) weigh(choice, k, largest[first + k], size);
    return choice;
}

Choice chooseEight(uint first, uint size, PoolTable table) {
    Choice choice = Choice(8u, 0u);
    [[unroll]] for (uint k = 0u; k < 8u; k++) weigh(choice, k, eightAt(first + k, table), size);
    return choice;
}

Choice chooseRange(uint first, uint size, PoolTable table) {
    Choice choice = Choice(8u, 0u);
    [[unroll]] for (uint k = 0u; k < 8u; k++) weigh(choice, k, sizeAt(first + k, table), size);
    return choice;
}

struct Taken {
    uint at; // range of the list, NO_INDEX if none is large enough
    uint begin;
    uint left; // of the range
};

// Takes elements from the front of the first range that has as many.
Taken take(uint root, uint size, PoolTable table) {
    Choice of_tops = chooseNode(root + TOPS, size);
    uint top = min(of_tops.at, 7u);
    Choice of_cubes = chooseNode(root + CUBES + 8u * top, size);
    uint cube = 8u * top + min(of_cubes.at, 7u);
    Choice of_squares = chooseNode(root + SQUARES + 8u * cube, size);
    uint square = 8u * cube + min(of_squares.at, 7u);
    Choice of_eights = chooseEight(8u * square, size, table);
    uint eight = 8u * square + min(of_eights.at, 7u);
    Choice of_ranges = chooseRange(8u * eight, size, table);
    uint at = 8u * eight + min(of_ranges.at, 7u);
    if (of_tops.at == 8u || size == 0u) return Taken(NO_INDEX, 0u, 0u);
    uvec2 range = free_ranges[table.from + at];
    free_ranges[table.from + at] = range + uvec2(size, -size);
    uint most = max(range.y - size, of_ranges.beside);
    free_ranges[table.to + eight].x = most;
    most = max(most, of_eights.beside);
    largest[root + SQUARES + square] = most;
    most = max(most, of_squares.beside);
    largest[root + CUBES + cube] = most;
    largest[root + TOPS + top] = max(most, of_cubes.beside);
    return Taken(at, range.x, range.y - size);
}

// Undone from the last to the first or in any other order, takes leave the list as it was.
void giveBack(uint root, uint at, uint size, PoolTable table) {
    uvec2 range = free_ranges[table.from + at] - uvec2(size, -size);
    free_ranges[table.from + at] = range;
    uint eight = table.to + at / 8u, square = root + SQUARES + at / 64u;
    uint cube = root + CUBES + at / 512u, top = root + TOPS + at / 4096u;
    free_ranges[eight].x = max(free_ranges[eight].x, range.y);
    largest[square] = max(largest[square], range.y);
    largest[cube] = max(largest[cube], range.y);
    largest[top] = max(largest[top], range.y);
}

struct Owner {
    uint first, end;
    bool fits; // its requests are all in the list
};

Owner ownerAt(uint o) {
    uint first = owner_start[o], end = owner_start[o + 1u];
    return Owner(min(first, request_room), min(end, request_room), first <= end && end <= request_room);
}

// A pool while its lane takes from it.
struct Taking {
    PoolTable table;
    uint root, taken, lacked;
    bool emptied;
};

// Serves an owner as if there were no other pool; returns how many elements it asked for in requests that found no range. Adds
// what it takes.
uint serve(inout Taking pool, Owner owner, uint lane, inout uint taken) {
    uint lacks = owner.fits ? 0u : NO_INDEX;
    for (uint r = owner.first; r < owner.end; r++) {
        uint size = owner.fits ? requests[POOLS * r + lane] : NO_INDEX;
        Taken part = take(pool.root, size, pool.table);
        bool served = part.at != NO_INDEX;
        lacks = served ? lacks : lacks + min(size, NO_INDEX - lacks);
        taken += served ? size : 0u;
        pool.emptied = pool.emptied || (served && part.left == 0u);
        taken_from[POOLS * r + lane] = part.at;
        begins[POOLS * r + lane] = part.begin;
    }
    return lacks;
}

void refuse(Taking pool, Owner owner, uint lane) {
    for (uint r = owner.first; r < owner.end; r++) {
        uint at = taken_from[POOLS * r + lane];
        if (at != NO_INDEX) giveBack(pool.root, at, requests[POOLS * r + lane], pool.table);
        begins[POOLS * r + lane] = NO_INDEX;
    }
}

// All lanes come here; those without a pool have no requests to walk through.
void serveOwner(inout Taking pool, uint o, uint lane) {
    bool idle = lane >= POOLS;
    Owner owner = ownerAt(o);
    if (idle) owner.end = owner.first;
    uint taken = 0u, lacks = serve(pool, owner, lane, taken);
    if (!idle) missing[lane] = lacks;
    sync();
    bool refused = (missing[0] | missing[1] | missing[2] | missing[3]) != 0u;
    if (!refused) owner.first = owner.end;
    refuse(pool, owner, lane);
    pool.taken += refused ? 0u : taken;
    pool.lacked += lacks != 0u ? 1u : 0u;
    if (!idle) lacking[POOLS * o + lane] = lacks;
    sync();
}

void noteTaken(Taking pool, uint lane, uint status) {
    uint in_use = headers[lane].in_use + pool.taken;
    headers[lane].in_use = in_use;
    headers[lane].most_in_use = max(headers[lane].most_in_use, in_use);
    headers[lane].lacked += pool.lacked;
    headers[lane].status |= status;
    emptied[lane] = pool.emptied ? 1u : 0u;
}

// Leaves out ranges that are used up: what is left goes to the other half of the table.
void pack(uint lane, uint pool) {
    PoolTable table = tableOf(pool);
    uint each = (table.count + LANES - 1u) / LANES, first = min(lane * each, table.count);
    uint end = min(first + each, table.count), stay = 0u;
    for (uint k = first; k < end; k++) stay += free_ranges[table.from + k].y != 0u ? 1u : 0u;
    uint at = table.to + sumBefore(lane, stay), total = lane_sum[LANES - 1u];
    for (uint k = first; k < end; k++) {
        uvec2 range = free_ranges[table.from + k];
        if (range.y != 0u) free_ranges[at++] = range;
    }
    sync();
    if (lane == 0u) {
        headers[pool].free_ranges = total;
        headers[pool].side ^= 1u;
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x, asked = counts[owner_count], owners = min(asked, owner_room);
    if (asked == 0u) return;
    for (uint pool = 0u; pool < ROLLED(POOLS); pool++) makeTree(lane, pool);
    uint own = min(lane, POOLS - 1u);
    Taking pool = Taking(tableOf(own), own * TREE, 0u, 0u, false);
    for (uint o = 0u; o < owners; o++) serveOwner(pool, o, lane);
    bool over = asked > owner_room || owner_start[owners] > request_room;
    if (lane < POOLS) noteTaken(pool, lane, over ? POOL_LIST_FULL : 0u);
    syncBuffers();
    for (uint p = 0u; p < ROLLED(POOLS); p++)
        if (emptied[p] != 0u) pack(lane, p);
}
