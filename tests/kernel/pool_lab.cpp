#include "tests/kernel/pool_lab.h"

#include <algorithm>

namespace kernel_test {
namespace {

constexpr uint32_t kReturned = 3, kOwners = 7; // any two counts

Requests requestsOf(const PoolDemand& demand) {
    Requests all;
    for (const Requests& owner : demand.owners)
        all.insert(all.end(), owner.begin(), owner.end());
    return all;
}

std::vector<uint32_t> startsOf(const PoolDemand& demand) {
    std::vector<uint32_t> starts = {0};
    for (const Requests& owner : demand.owners)
        starts.push_back(starts.back() + static_cast<uint32_t>(owner.size()));
    return starts;
}

brittle::PoolState stateWith(const brittle::PoolRoom& room, const brittle::FreeLists& free) {
    const auto state = brittle::poolsWith(room, free);
    ENGINE_ASSERT(state.has_value());
    return *state;
}

} // namespace

gpu::PoolShare shareOf(const Word4& begin, const Word4& size) {
    return {{begin[0], begin[1], begin[2], begin[3]}, {size[0], size[1], size[2], size[3]}};
}

Word4 sizesOf(const gpu::PoolShare& share) { return {share.size.x, share.size.y, share.size.z, share.size.w}; }

Shares sharesOf(const PoolDemand& demand, const PoolAnswer& answer) {
    Shares shares;
    size_t request = 0;
    for (size_t o = 0; o < demand.owners.size(); ++o)
        for (const Word4& size : demand.owners[o]) {
            const Word4& begin = answer.begins[request++];
            if (answer.lacking[o] == Word4{}) shares.push_back(shareOf(begin, size));
        }
    return shares;
}

MarkedPools::MarkedPools(const brittle::PoolRoom& room, const brittle::FreeLists& free) {
    for (uint32_t pool = 0; pool < POOLS; ++pool) {
        used_[pool].assign(room.capacity[pool], 1);
        for (const auto& range : free[pool])
            mark(pool, range.begin, range.size, 0);
    }
}

void MarkedPools::mark(uint32_t pool, uint32_t begin, uint32_t size, uint8_t used) {
    std::fill_n(used_[pool].begin() + begin, size, used);
}

uint32_t MarkedPools::firstFit(uint32_t pool, uint32_t size) const {
    uint32_t free = 0;
    for (uint32_t k = 0; k < used_[pool].size(); ++k) {
        free = used_[pool][k] != 0 ? 0 : free + 1;
        if (free == size) return k + 1 - size;
    }
    return NO_INDEX;
}

Word4 MarkedPools::serve(const Requests& requests, PoolAnswer& answer) {
    const auto before = used_;
    Word4 lacking = {};
    const size_t first = answer.begins.size();
    for (const Word4& sizes : requests) {
        Word4 begins = {};
        for (uint32_t pool = 0; pool < POOLS; ++pool) {
            if (sizes[pool] == 0) continue;
            begins[pool] = firstFit(pool, sizes[pool]);
            if (begins[pool] == NO_INDEX)
                lacking[pool] += sizes[pool];
            else
                mark(pool, begins[pool], sizes[pool], 1);
        }
        answer.begins.push_back(begins);
    }
    if (lacking == Word4{}) return lacking;
    used_ = before;
    std::fill(answer.begins.begin() + static_cast<ptrdiff_t>(first), answer.begins.end(),
              Word4{NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX});
    return lacking;
}

PoolAnswer MarkedPools::step(const PoolDemand& demand) {
    for (const gpu::PoolShare& share : demand.returned) {
        const Word4 begin = {share.begin.x, share.begin.y, share.begin.z, share.begin.w}, size = sizesOf(share);
        for (uint32_t pool = 0; pool < POOLS; ++pool)
            if (size[pool] != 0) mark(pool, begin[pool], size[pool], 0);
    }
    PoolAnswer answer;
    for (const Requests& owner : demand.owners)
        answer.lacking.push_back(serve(owner, answer));
    return answer;
}

brittle::FreeLists MarkedPools::lists() const {
    brittle::FreeLists lists;
    for (uint32_t pool = 0; pool < POOLS; ++pool)
        for (uint32_t k = 0; k < used_[pool].size(); ++k) {
            if (used_[pool][k] != 0) continue;
            if (k == 0 || used_[pool][k - 1] != 0) lists[pool].push_back({k, 0});
            ++lists[pool].back().size;
        }
    return lists;
}

uint32_t MarkedPools::inUse(uint32_t pool) const { return static_cast<uint32_t>(std::ranges::count(used_[pool], uint8_t{1})); }

DemandBuffers::DemandBuffers(const PoolDemand& demand, const brittle::PoolRoom& room)
    : owners_(demand.owners.size()), requests_(requestsOf(demand).size()), returned_(bufferOf(demand.returned, room.returned)),
      sizes_(bufferOf(requestsOf(demand), room.requests)), owner_start_(bufferOf(startsOf(demand))),
      begins_(blankBuffer<Word4>(room.requests)), lacking_(blankBuffer<Word4>(room.owners)) {
    counts[kReturned] = static_cast<uint32_t>(demand.returned.size());
    counts[kOwners] = static_cast<uint32_t>(owners_);
}

void DemandBuffers::record(engine::Commands& commands, const brittle::PoolRoom& room, const brittle::PoolBuffers& pools,
                           bool many_lanes) {
    brittle::Recorder recorder(commands, kernels(), counts.words, counts.args);
    brittle::recordReturn(recorder, room, pools, {kReturned, returned_}, many_lanes);
    brittle::recordTake(recorder, room, pools, {kOwners, sizes_, owner_start_, begins_, lacking_}, many_lanes);
    ENGINE_ASSERT(recorder.status().has_value());
}

PoolAnswer DemandBuffers::answer() const { return {valuesOf<Word4>(begins_, requests_), valuesOf<Word4>(lacking_, owners_)}; }

DevicePools::DevicePools(const brittle::PoolRoom& room, const brittle::FreeLists& free, bool many_lanes)
    : DevicePools(room, stateWith(room, free), many_lanes) {}

DevicePools::DevicePools(const brittle::PoolRoom& room, const brittle::PoolState& state, bool many_lanes)
    : room_(room), many_lanes_(many_lanes),
      headers_(bufferOf(std::vector<gpu::PoolHeader>(state.headers.begin(), state.headers.end()))),
      ranges_(bufferOf(state.ranges)), order_(blankBuffer<uint32_t>(2ull * POOLS * room.returned)),
      sorted_(blankBuffer<Word2>(size_t{POOLS} * room.returned)), taken_from_(blankBuffer<Word4>(room.requests)) {}

brittle::PoolBuffers DevicePools::buffers() const { return {headers_, ranges_, order_, sorted_, taken_from_}; }

PoolAnswer DevicePools::step(const PoolDemand& demand) {
    DemandBuffers buffers(demand, room_);
    return step(buffers);
}

PoolAnswer DevicePools::step(DemandBuffers& demand) {
    onDevice([&](engine::Commands& commands) { demand.record(commands, room_, buffers(), many_lanes_); });
    return demand.answer();
}

brittle::PoolState DevicePools::state() const {
    brittle::PoolState state;
    std::copy_n(headers_.mappedAs<gpu::PoolHeader>(), POOLS, state.headers.begin());
    state.ranges = valuesOf<brittle::FreeRange>(ranges_, 2 * POOLS * size_t{room_.ranges()});
    return state;
}

PoolDemand PoolLife::next() {
    PoolDemand demand;
    std::ranges::shuffle(held_, random_);
    const size_t stay = held_.size() - below(static_cast<uint32_t>(held_.size()) + 1) / (1 + below(4));
    demand.returned.assign(held_.begin() + static_cast<ptrdiff_t>(stay), held_.end());
    held_.resize(stay);
    demand.owners.resize(below(most_owners_ + 1));
    for (Requests& owner : demand.owners) {
        owner.resize(below(most_requests_ + 1));
        for (Word4& size : owner)
            for (uint32_t pool = 0; pool < POOLS; ++pool)
                size[pool] = below(largest_[pool] + 1);
    }
    return demand;
}

PoolDemand PoolLife::last() { return {std::exchange(held_, {}), {}}; }

void PoolLife::note(const PoolDemand& demand, const PoolAnswer& answer) {
    const Shares shares = sharesOf(demand, answer);
    held_.insert(held_.end(), shares.begin(), shares.end());
}

} // namespace kernel_test
