#include "modules/brittle/breaking/world_pools.h"

#include <algorithm>
#include <string>

namespace brittle {
namespace {

constexpr const char* kNames[POOLS] = {"bodies", "pieces", "faces", "triangles"};

engine::Error tooMany(const std::string& what, uint32_t asked, uint32_t most) {
    return {engine::ErrorCode::Capacity,
            "pools can hold " + std::to_string(most) + " " + what + ", not " + std::to_string(asked)};
}

engine::Result<void> check(const PoolRoom& room) {
    if (room.ranges() > POOL_MOST_FREE) return tooMany("free ranges", room.ranges(), POOL_MOST_FREE);
    if (room.returned > POOL_MOST_RETURNED) return tooMany("ranges returned in a step", room.returned, POOL_MOST_RETURNED);
    if (room.owners > POOL_MOST_OWNERS) return tooMany("objects that break in a step", room.owners, POOL_MOST_OWNERS);
    if (room.requests > POOL_MOST_REQUESTS) return tooMany("requests in a step", room.requests, POOL_MOST_REQUESTS);
    for (const uint32_t capacity : room.capacity)
        if (capacity > INT32_MAX) return tooMany("elements", capacity, INT32_MAX);
    return {};
}

// In order, within the pool and not touching; returns how many elements are free.
engine::Result<uint32_t> freeOf(const std::vector<FreeRange>& list, uint32_t capacity, const std::string& name) {
    uint64_t before = 0, sum = 0;
    for (const FreeRange& range : list) {
        const bool apart = sum == 0 || range.begin > before;
        before = uint64_t{range.begin} + range.size;
        sum += range.size;
        if (!apart || range.size == 0 || before > capacity)
            return engine::Error{engine::ErrorCode::BadInput,
                                 "free ranges of " + name + " are not in order, touch, or reach beyond the pool"};
    }
    return static_cast<uint32_t>(sum);
}

std::string named(const std::string& kernel, bool many_lanes) { return kernel + (many_lanes ? "_wide" : ""); }

} // namespace

uint32_t PoolRoom::ranges() const {
    const uint32_t largest = *std::ranges::max_element(capacity);
    const uint32_t apart = std::max(listed, std::min(largest / 2 + largest % 2, objects < NO_INDEX ? objects + 1 : objects));
    return (apart + 7) / 8 * 8; // whole eights, in which lists are searched
}

engine::Result<PoolBuffers> layOutPools(engine::ScratchArena& lasting, engine::ScratchArena& scratch, const PoolRoom& room) {
    if (const auto fits = check(room); !fits) return fits.error();
    PoolBuffers b;
    b.headers = lasting.take(POOLS * sizeof(gpu::PoolHeader));
    b.free_ranges = lasting.take(2 * POOLS * sizeof(FreeRange) * room.ranges());
    b.order = scratch.take(8ull * POOLS * std::max(room.returned, 1u));
    b.sorted = scratch.take(8ull * POOLS * std::max(room.returned, 1u));
    b.taken_from = scratch.take(4ull * POOLS * std::max(room.requests, 1u));
    return b;
}

FreeLists allFree(const PoolRoom& room) {
    FreeLists lists;
    for (size_t pool = 0; pool < POOLS; ++pool)
        if (room.capacity[pool] > 0) lists[pool] = {{0, room.capacity[pool]}};
    return lists;
}

engine::Result<PoolState> poolsWith(const PoolRoom& room, const FreeLists& free) {
    if (const auto fits = check(room); !fits) return fits.error();
    PoolState state;
    state.ranges.resize(2 * POOLS * size_t{room.ranges()});
    for (size_t pool = 0; pool < POOLS; ++pool) {
        const auto elements = freeOf(free[pool], room.capacity[pool], kNames[pool]);
        if (!elements) return elements.error();
        const auto count = static_cast<uint32_t>(free[pool].size());
        if (count > room.ranges()) return tooMany("free ranges", count, room.ranges());
        gpu::PoolHeader& header = state.headers[pool];
        header.capacity = room.capacity[pool];
        header.free_ranges = count;
        header.in_use = header.most_in_use = room.capacity[pool] - *elements;
        std::ranges::copy(free[pool], state.ranges.begin() + static_cast<ptrdiff_t>(2 * pool * room.ranges()));
    }
    return state;
}

FreeLists PoolState::lists(const PoolRoom& room) const {
    FreeLists lists;
    for (size_t pool = 0; pool < POOLS; ++pool) {
        const auto first = ranges.begin() + static_cast<ptrdiff_t>((2 * pool + headers[pool].side) * room.ranges());
        lists[pool].assign(first, first + headers[pool].free_ranges);
    }
    return lists;
}

void recordReturn(Recorder& record, const PoolRoom& room, const PoolBuffers& b, const PoolReturns& returns, bool many_lanes) {
    struct Push {
        uint32_t returned_count, returned_room, range_room;
    } push = {returns.count, room.returned, room.ranges()};
    const std::string name = named("return_ranges", many_lanes);
    const Recorder::Views buffers = {record.counts(), returns.returned, b.headers, b.free_ranges, b.order, b.sorted};
    if (returns.groups.buffer != nullptr) return record.runGroups(name, returns.groups, push, buffers);
    record.runGroups(name, POOLS, push, buffers);
}

void recordTake(Recorder& record, const PoolRoom& room, const PoolBuffers& b, const PoolRequests& requests, bool many_lanes) {
    struct Push {
        uint32_t owner_count, owner_room, request_room, range_room;
    } push = {requests.owner_count, room.owners, room.requests, room.ranges()};
    record.runGroups(named("take_ranges", many_lanes), 1u, push,
                     {record.counts(), requests.sizes, requests.owner_start, b.headers, b.free_ranges, b.taken_from,
                      requests.begins, requests.lacking});
}

} // namespace brittle
