// Pools of a running world: bodies, their pieces, faces of their hulls, triangles of their surfaces. What is free of them is
// known to the device alone, where fragments take ranges and objects that have broken or expired return theirs in one step.
#pragma once

#include "engine/arena.h"
#include "modules/brittle/fracture/recorder.h"
#include "shaders-spirv/shared/pool.h"

#include <array>
#include <span>
#include <vector>

namespace brittle {

struct PoolRoom {
    std::array<uint32_t, POOLS> capacity = {}; // elements
    uint32_t objects = 0;                      // the most at a time, each with one range of a pool at most
    // The most in one step.
    uint32_t returned = 0;
    uint32_t owners = 0;
    uint32_t requests = 0;
    // Entries of a half of a table: as many ranges as can be free (shaders-spirv/shared/pool.h), and no fewer than `listed`,
    // for lists that were never taken from ranges of objects.
    uint32_t listed = 0;
    uint32_t ranges() const;
};

struct PoolBuffers {
    engine::BufferView headers, free_ranges;      // the pools; copied, all there is to keep of them
    engine::BufferView order, sorted, taken_from; // scratch memory
};
// Refuses more than the kernels can walk through.
engine::Result<PoolBuffers> layOutPools(engine::ScratchArena& lasting, engine::ScratchArena& scratch, const PoolRoom& room);

struct FreeRange {
    uint32_t begin = 0, size = 0;
    bool operator==(const FreeRange&) const = default;
};
using FreeLists = std::array<std::vector<FreeRange>, POOLS>; // in order, none touching

struct PoolState {
    std::array<gpu::PoolHeader, POOLS> headers = {};
    std::vector<FreeRange> ranges; // of both halves of all tables
    FreeLists lists(const PoolRoom& room) const;
};
// What buffers hold before anything is taken but what the lists leave out.
engine::Result<PoolState> poolsWith(const PoolRoom& room, const FreeLists& free);
FreeLists allFree(const PoolRoom& room);

// Both read their count where they run, and end at once where it is 0. An object that breaks keeps its own ranges until its
// fragments have theirs, since it stays whole where there is no room: it takes first, and returns where nothing was lacking.
struct PoolReturns {
    uint32_t count = NO_INDEX;   // index into the counts
    engine::BufferView returned; // PoolShares, in any order
    engine::BufferView groups;   // dispatch arguments, of POOLS workgroups or none; empty: always
};
struct PoolRequests {
    uint32_t owner_count = NO_INDEX;
    engine::BufferView sizes;       // of every request POOLS words, 0 where it wants nothing of a pool
    engine::BufferView owner_start; // first request of each owner, in order, and behind the last
    engine::BufferView begins;      // out: of every request POOLS words, all NO_INDEX where its owner was refused
    // Out: of every owner POOLS words, how many elements it asked for in requests that found no range, NO_INDEX if its requests
    // did not fit in their list. All are 0 where it was served.
    engine::BufferView lacking;
};
// `many_lanes`: subgroups of the device have 32 and more.
void recordReturn(Recorder& record, const PoolRoom& room, const PoolBuffers& b, const PoolReturns& returns, bool many_lanes);
void recordTake(Recorder& record, const PoolRoom& room, const PoolBuffers& b, const PoolRequests& requests, bool many_lanes);

} // namespace brittle
