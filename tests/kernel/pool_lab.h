// Pools on the device, and the same with a byte an element on the host: what is free is what is not marked.
#pragma once

#include "modules/brittle/breaking/world_pools.h"
#include "tests/kernel/lab.h"

#include <random>

namespace kernel_test {

using Shares = std::vector<gpu::PoolShare>;
using Requests = std::vector<Word4>; // a size from each pool

// What becomes of a step: first all ranges are returned, then owners are served in order.
struct PoolDemand {
    Shares returned;
    std::vector<Requests> owners;
};

struct PoolAnswer {
    std::vector<Word4> begins;  // of all requests in order
    std::vector<Word4> lacking; // of all owners
    bool operator==(const PoolAnswer&) const = default;
};

gpu::PoolShare shareOf(const Word4& begin, const Word4& size);
Word4 sizesOf(const gpu::PoolShare& share);
// What the owners hold that were served.
Shares sharesOf(const PoolDemand& demand, const PoolAnswer& answer);

class MarkedPools {
public:
    MarkedPools(const brittle::PoolRoom& room, const brittle::FreeLists& free);
    PoolAnswer step(const PoolDemand& demand);
    brittle::FreeLists lists() const;
    uint32_t inUse(uint32_t pool) const;

private:
    uint32_t firstFit(uint32_t pool, uint32_t size) const;
    void mark(uint32_t pool, uint32_t begin, uint32_t size, uint8_t used);
    Word4 serve(const Requests& requests, PoolAnswer& answer);

    std::array<std::vector<uint8_t>, POOLS> used_;
};

// The buffers of a step's demand.
class DemandBuffers {
public:
    DemandBuffers(const PoolDemand& demand, const brittle::PoolRoom& room);
    void record(engine::Commands& commands, const brittle::PoolRoom& room, const brittle::PoolBuffers& pools, bool many_lanes);
    PoolAnswer answer() const;
    Counts counts;

private:
    size_t owners_, requests_;
    engine::Buffer returned_, sizes_, owner_start_, begins_, lacking_;
};

class DevicePools {
public:
    DevicePools(const brittle::PoolRoom& room, const brittle::FreeLists& free, bool many_lanes = false);
    DevicePools(const brittle::PoolRoom& room, const brittle::PoolState& state, bool many_lanes = false);
    PoolAnswer step(const PoolDemand& demand);
    PoolAnswer step(DemandBuffers& demand);
    brittle::PoolState state() const;
    brittle::FreeLists lists() const { return state().lists(room_); }
    const gpu::PoolHeader& header(uint32_t pool) const { return headers_.mappedAs<gpu::PoolHeader>()[pool]; }
    brittle::PoolBuffers buffers() const;

private:
    brittle::PoolRoom room_;
    bool many_lanes_;
    engine::Buffer headers_, ranges_, order_, sorted_, taken_from_;
};

// Objects that come and go: what a step returns was taken in one before.
class PoolLife {
public:
    PoolLife(uint32_t seed, uint32_t most_owners, uint32_t most_requests, Word4 largest)
        : random_(seed), most_owners_(most_owners), most_requests_(most_requests), largest_(largest) {}
    // A part of what is there is returned, in any order, and some ask for more.
    PoolDemand next();
    PoolDemand last(); // all is returned
    void note(const PoolDemand& demand, const PoolAnswer& answer);
    size_t count() const { return held_.size(); }

private:
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_() % n); }

    std::mt19937 random_;
    uint32_t most_owners_, most_requests_;
    Word4 largest_;
    Shares held_;
};

} // namespace kernel_test
