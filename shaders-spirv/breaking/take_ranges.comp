// Takes ranges from the pools for objects that break, all that an object asks for or nothing: it becomes all of its fragments or
// stays whole. Objects and their requests are served in order, each from the first range that is large enough.
//
// One workgroup does it, a lane a pool: what an object finds depends on all that came before it, and on all pools. Over each list
// lies a tree of the largest size under every eight, so that a search takes four looks at eight; and since it has then seen what
// else there is beside its way, the tree is right again after a store a level. That is one turn of a loop a request, where walks
// along lists would take more than Mesa's software device allows (shaders-spirv/README.md). The other lanes help to make the
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

// Largest sizes of a pool's ranges: below every eight ranges, every 64, and every 512.
#define EIGHTS 0u
#define SQUARES 512u
#define CUBES 576u
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
    uint root = pool * TREE, squares = (table.count + 63u) / 64u, all_squares = (squares + 7u) / 8u * 8u;
    for (uint k = lane; k < 8u * all_squares; k += LANES) {
        uint most = 0u;
        [[unroll]] for (uint child = 0u; child < 8u; child++) most = max(most, sizeAt(8u * k + child, table));
        largest[root + EIGHTS + k] = most;
    }
    if (lane < 8u) largest[root + CUBES + lane] = 0u;
    sync();
    joinLevel(lane, root + EIGHTS, root + SQUARES, all_squares);
    joinLevel(lane, root + SQUARES, root + CUBES, all_squares / 8u);
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
    Choice top = chooseNode(root + CUBES, size);
    uint cube = min(top.at, 7u);
    Choice middle = chooseNode(root + SQUARES + 8u * cube, size);
    uint square = 8u * cube + min(middle.at, 7u);
    Choice low = chooseNode(root + EIGHTS + 8u * square, size);
    uint eight = 8u * square + min(low.at, 7u);
    Choice leaf = chooseRange(8u * eight, size, table);
    uint at = 8u * eight + min(leaf.at, 7u);
    if (top.at == 8u || size == 0u) return Taken(NO_INDEX, 0u, 0u);
    uvec2 range = free_ranges[table.from + at];
    free_ranges[table.from + at] = range + uvec2(size, -size);
    uint most = max(range.y - size, leaf.beside);
    largest[root + EIGHTS + eight] = most;
    most = max(most, low.beside);
    largest[root + SQUARES + square] = most;
    largest[root + CUBES + cube] = max(most, middle.beside);
    return Taken(at, range.x, range.y - size);
}

// Undone from the last to the first or in any other order, takes leave the list as it was.
void giveBack(uint root, uint at, uint size, PoolTable table) {
    uvec2 range = free_ranges[table.from + at] - uvec2(size, -size);
    free_ranges[table.from + at] = range;
    uint eight = root + EIGHTS + at / 8u, square = root + SQUARES + at / 64u, cube = root + CUBES + at / 512u;
    largest[eight] = max(largest[eight], range.y);
    largest[square] = max(largest[square], range.y);
    largest[cube] = max(largest[cube], range.y);
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
