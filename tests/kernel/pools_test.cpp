// Pools of a running world: what the device gives and takes back is what a host would that marks every element.
#include "tests/kernel/pool_lab.h"

#include <algorithm>

namespace kernel_test {
namespace {

using brittle::FreeLists, brittle::FreeRange, brittle::PoolRoom;

constexpr Word4 kNone = {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX};

PoolRoom smallRoom() {
    return {.capacity = {64, 300, 1000, 77}, .objects = 600, .returned = 600, .owners = 64, .requests = 640};
}

// Of an object that has the same range in all pools.
gpu::PoolShare everywhere(uint32_t begin, uint32_t size) {
    return shareOf({begin, begin, begin, begin}, {size, size, size, size});
}

void expectSame(const DevicePools& device, const MarkedPools& host) {
    EXPECT_EQ(device.lists(), host.lists());
    for (uint32_t pool = 0; pool < POOLS; ++pool) {
        EXPECT_EQ(device.header(pool).in_use, host.inUse(pool));
        EXPECT_EQ(device.header(pool).status, 0u);
    }
}

// Lives of objects, with pools that run short now and then. Returns how many owners were refused.
uint32_t liveBoth(const PoolRoom& room, PoolLife life, uint32_t steps, bool many_lanes) {
    DevicePools device(room, brittle::allFree(room), many_lanes);
    MarkedPools host(room, brittle::allFree(room));
    uint32_t refused = 0;
    for (uint32_t step = 0; step < steps; ++step) {
        const PoolDemand demand = life.next();
        const PoolAnswer answer = host.step(demand);
        EXPECT_EQ(device.step(demand), answer) << step;
        expectSame(device, host);
        life.note(demand, answer);
        refused += static_cast<uint32_t>(std::ranges::count_if(answer.lacking, [](const Word4& l) { return l != Word4{}; }));
        if (testing::Test::HasFailure()) return refused;
    }
    device.step(life.last());
    EXPECT_EQ(device.lists(), brittle::allFree(room));
    return refused;
}

} // namespace

TEST(SmallPools, AreThoseOfAHostThatMarksEveryElement) {
    for (const bool many_lanes : {false, true}) {
        const uint32_t refused = liveBoth(smallRoom(), PoolLife(17, 12, 8, {1, 6, 20, 2}), 40, many_lanes);
        EXPECT_GT(refused, 20u) << "pools never ran short";
    }
}

TEST(Pools, AreThoseOfAHostThatMarksEveryElement) {
    const PoolRoom large{
        .capacity = {1000, 3000, 9000, 20'000}, .objects = 2000, .returned = 2000, .owners = 64, .requests = 2048};
    for (const bool many_lanes : {false, true})
        for (uint32_t seed = 0; seed < 4; ++seed) {
            EXPECT_GT(liveBoth(smallRoom(), PoolLife(seed, 12, 8, {1, 6, 20, 2}), 100, many_lanes), 20u);
            EXPECT_GT(liveBoth(large, PoolLife(seed, 64, 32, {1, 7, 20, 60}), 20, many_lanes), 20u);
        }
}

TEST(SmallPools, ServeAnOwnerFromAllOrFromNone) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, brittle::allFree(room));
    // The second asks for more triangles than are left, in its second request, after the first was served from all pools.
    const PoolAnswer answer =
        pools.step({{}, {{{1, 10, 20, 70}}, {{2, 10, 10, 5}, {1, 1, 1, 3}, {1, 1, 1, 2}}, {{3, 5, 1000, 1}}, {{4, 5, 6, 7}}}});
    EXPECT_EQ(answer.begins, (Requests{{0, 0, 0, 0}, kNone, kNone, kNone, kNone, {1, 10, 20, 70}}));
    EXPECT_EQ(answer.lacking, (Requests{{0, 0, 0, 0}, {0, 0, 0, 3}, {0, 0, 1000, 0}, {0, 0, 0, 0}}));
    EXPECT_EQ(pools.header(POOL_FACES).lacked, 1u);
    EXPECT_EQ(pools.header(POOL_TRIANGLES).lacked, 1u);
    EXPECT_EQ(pools.header(POOL_BODIES).in_use, 5u);
}

TEST(SmallPools, ServeFromTheFirstRangeThatIsLargeEnough) {
    const PoolRoom room = smallRoom();
    const std::vector<FreeRange> list = {{0, 2}, {4, 5}, {20, 3}, {40, 10}};
    DevicePools pools(room, {list, list, list, list});
    EXPECT_EQ(pools.step({{}, {{{3, 5, 6, 0}, {1, 5, 2, 11}}}}).begins, (Requests{kNone, kNone}));
    EXPECT_EQ(pools.step({{}, {{{3, 5, 6, 0}, {1, 5, 2, 10}}}}).begins, (Requests{{4, 4, 40, 0}, {0, 40, 0, 40}}));
    EXPECT_EQ(pools.lists()[POOL_BODIES], (std::vector<FreeRange>{{1, 1}, {7, 2}, {20, 3}, {40, 10}}));
    EXPECT_EQ(pools.lists()[POOL_TRIANGLES], (std::vector<FreeRange>{{0, 2}, {4, 5}, {20, 3}}));
}

TEST(SmallPools, AreUsedToTheLastElement) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, brittle::allFree(room));
    const Word4 all = room.capacity;
    EXPECT_EQ(pools.step({{}, {{all}, {{1, 0, 0, 0}}}}).lacking, (Requests{{}, {1, 0, 0, 0}}));
    EXPECT_EQ(pools.lists(), FreeLists{});
    EXPECT_EQ(pools.step({{}, {{{0, 0, 0, 1}}, {{0, 0, 0, 0}}}}).begins, (Requests{kNone, {0, 0, 0, 0}}));
    EXPECT_EQ(pools.step({{shareOf({}, all)}, {{all}}}).lacking, (Requests{{}}));
    pools.step({{shareOf({}, all)}, {}});
    EXPECT_EQ(pools.lists(), brittle::allFree(room));
    for (uint32_t pool = 0; pool < POOLS; ++pool) {
        EXPECT_EQ(pools.header(pool).in_use, 0u);
        EXPECT_EQ(pools.header(pool).most_in_use, all[pool]);
    }
}

TEST(SmallPools, InPiecesServeOnlyWhatIsSmallUntilPiecesJoin) {
    const PoolRoom room{.capacity = {64, 64, 64, 64}, .objects = 64, .returned = 64, .owners = 8, .requests = 64};
    DevicePools pools(room, FreeLists{});
    PoolDemand every_other, others;
    for (uint32_t k = 0; k < 64; k += 4) {
        every_other.returned.push_back(everywhere(k, 2));
        others.returned.push_back(everywhere(k + 2, 2));
    }
    pools.step(every_other);
    EXPECT_EQ(pools.lists()[0].size(), 16u);
    EXPECT_EQ(pools.header(0).in_use, 32u);
    EXPECT_EQ(pools.step({{}, {{{0, 0, 3, 0}}}}).lacking, (Requests{{0, 0, 3, 0}})) << "32 are free, but not three in a row";
    EXPECT_EQ(pools.step({{}, {{{2, 2, 2, 2}}}}).begins, (Requests{{0, 0, 0, 0}}));
    others.returned.push_back(everywhere(0, 2));
    pools.step(others);
    EXPECT_EQ(pools.lists(), brittle::allFree(room));
    EXPECT_EQ(pools.step({{}, {{{64, 64, 64, 64}}}}).lacking, (Requests{{}}));
}

TEST(SmallPools, AreTheSameInWhateverOrderRangesReturn) {
    const PoolRoom room = smallRoom();
    std::mt19937 random(5);
    for (const bool overlap : {false, true}) {
        PoolDemand demand;
        for (uint32_t k = 0; k < 60; k += 1 + static_cast<uint32_t>(random() % 3))
            demand.returned.push_back(everywhere(k, 1 + (overlap ? static_cast<uint32_t>(random() % 5) : 0)));
        demand.owners = {{{3, 4, 5, 1}, {1, 1, 1, 9}}};
        const FreeLists free = {{{{40, 3}}, {{64, 200}}, {{7, 2}, {77, 1}}, {}}};
        DevicePools first(room, overlap ? free : FreeLists{});
        const PoolAnswer answer = first.step(demand);
        for (int shuffle = 0; shuffle < 6; ++shuffle) {
            std::ranges::shuffle(demand.returned, random);
            DevicePools other(room, overlap ? free : FreeLists{}, shuffle % 2 == 1);
            EXPECT_EQ(other.step(demand), answer);
            EXPECT_EQ(other.lists(), first.lists());
            EXPECT_EQ(
                std::memcmp(other.state().headers.data(), first.state().headers.data(), sizeof(brittle::PoolState::headers)),
                0);
        }
    }
}

TEST(SmallPools, ReportWhatIsReturnedTwice) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, {{{{10, 10}}, {{10, 10}}, {{10, 10}}, {{10, 10}}}});
    pools.step({{shareOf({0, 0, 12, 25}, {10, 5, 3, 10}), shareOf({20, 3, 0, 30}, {2, 4, 0, 2})}, {}});
    const Word4 twice = {0, 2, 3, 2};
    for (uint32_t pool = 0; pool < POOLS; ++pool) {
        EXPECT_EQ(pools.header(pool).status, pool == 0 ? 0u : POOL_RETURNED_TWICE);
        EXPECT_EQ(pools.header(pool).returned_twice, twice[pool]);
    }
    EXPECT_EQ(pools.lists(), (FreeLists{{{{0, 22}}, {{0, 7}, {10, 10}}, {{10, 10}}, {{10, 10}, {25, 10}}}}));
}

TEST(SmallPools, LeaveOutWhatIsReturnedFromBeyondThem) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, FreeLists{});
    pools.step({{shareOf({63, 299, 1000, NO_INDEX}, {1, 2, 1, 2}), shareOf({70, 5, 5, 5}, {0, 1, NO_INDEX, 1})}, {}});
    EXPECT_EQ(pools.lists(), (FreeLists{{{{63, 1}}, {{5, 1}}, {}, {{5, 1}}}}));
    for (uint32_t pool = 0; pool < POOLS; ++pool)
        EXPECT_EQ(pools.header(pool).status, pool == 0 ? 0u : POOL_RETURNED_OUTSIDE) << pool;
}

TEST(SmallPools, ReportATableThatIsTooSmall) {
    const PoolRoom room{.capacity = {100, 100, 100, 100}, .objects = 7, .returned = 50, .owners = 1, .requests = 1};
    EXPECT_EQ(room.ranges(), 8u);
    DevicePools pools(room, FreeLists{});
    PoolDemand demand;
    for (uint32_t k = 0; k < 30; k += 3)
        demand.returned.push_back(everywhere(k, 2));
    pools.step(demand);
    const std::vector<FreeRange> left = {{0, 2}, {3, 2}, {6, 2}, {9, 2}, {12, 2}, {15, 2}, {18, 2}, {21, 2}};
    EXPECT_EQ(pools.lists(), (FreeLists{left, left, left, left}));
    EXPECT_EQ(pools.header(0).status, POOL_TABLE_FULL);
    EXPECT_EQ(pools.header(0).lost, 4u);
    EXPECT_EQ(pools.header(0).in_use, 84u);
}

TEST(SmallPools, ReportListsThatAreTooLong) {
    const PoolRoom room{.capacity = {9, 9, 9, 9}, .objects = 9, .returned = 2, .owners = 2, .requests = 2};
    DevicePools pools(room, {{{{0, 9}}, {{0, 5}}, {}, {}}});
    const Word4 one = {1, 0, 0, 0};
    // The requests of the second owner reach beyond the list.
    const PoolRoom more{.capacity = room.capacity, .objects = 9, .returned = 3, .owners = 2, .requests = 3};
    DemandBuffers requests({{}, {{one}, {one, one}}}, more);
    const PoolAnswer answer = pools.step(requests);
    EXPECT_EQ(answer.lacking, (Requests{{}, kNone}));
    EXPECT_EQ(answer.begins[0], Word4{});
    EXPECT_EQ(answer.begins[1], kNone);
    EXPECT_EQ(pools.header(0).status, POOL_LIST_FULL);
    DemandBuffers returns({{everywhere(0, 1), shareOf({}, {}), shareOf({0, 7, 0, 0}, {0, 1, 0, 0})}, {}}, more);
    pools.step(returns);
    EXPECT_EQ(pools.lists(), (FreeLists{{{{0, 9}}, {{0, 5}}, {{0, 1}}, {{0, 1}}}}));
    EXPECT_EQ(pools.header(2).status, POOL_LIST_FULL);
}

TEST(SmallPools, StayUntouchedWhereNothingIsAskedFor) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, brittle::allFree(room));
    pools.step({{}, {{{1, 2, 3, 4}}}});
    const brittle::PoolState before = pools.state();
    pools.step(PoolDemand{});
    pools.step({{shareOf({1, 2, 3, 4}, {})}, {{}}});
    EXPECT_EQ(pools.state().ranges, before.ranges);
    EXPECT_EQ(std::memcmp(pools.state().headers.data(), before.headers.data(), sizeof(before.headers)), 0);
}

TEST(SmallPools, GoOnTheSameFromASavedState) {
    const PoolRoom room = smallRoom();
    PoolLife life(8, 12, 8, {1, 6, 20, 2});
    DevicePools pools(room, brittle::allFree(room));
    const auto step = [&](DevicePools& each, const PoolDemand& demand) { return each.step(demand); };
    for (int k = 0; k < 20; ++k) {
        const PoolDemand demand = life.next();
        life.note(demand, step(pools, demand));
    }
    DevicePools restored(room, pools.state());
    for (int k = 0; k < 20; ++k) {
        const PoolDemand demand = life.next();
        const PoolAnswer answer = step(pools, demand);
        EXPECT_EQ(step(restored, demand), answer);
        life.note(demand, answer);
    }
    EXPECT_EQ(restored.lists(), pools.lists());
    EXPECT_EQ(restored.header(1).most_in_use, pools.header(1).most_in_use);
}

TEST(SmallPools, RefuseWhatTheKernelsCannotWalkThrough) {
    PoolRoom room = smallRoom();
    EXPECT_TRUE(brittle::poolsWith(room, brittle::allFree(room)));
    EXPECT_FALSE(brittle::poolsWith(room, {{{{0, 2}, {2, 1}}, {}, {}, {}}})) << "they touch";
    EXPECT_FALSE(brittle::poolsWith(room, {{{{0, 2}, {1, 4}}, {}, {}, {}}}));
    EXPECT_FALSE(brittle::poolsWith(room, {{{{60, 5}}, {}, {}, {}}})) << "beyond the pool";
    EXPECT_FALSE(brittle::poolsWith(room, {{{{60, 0}}, {}, {}, {}}}));
    room.requests = POOL_MOST_REQUESTS + 1;
    EXPECT_FALSE(brittle::poolsWith(room, brittle::allFree(room)));
    room = {.capacity = {0, 1u << 20, 0, 0}, .objects = POOL_MOST_FREE};
    EXPECT_FALSE(brittle::poolsWith(room, brittle::allFree(room)));
    room.objects = POOL_MOST_FREE - 1;
    EXPECT_TRUE(brittle::poolsWith(room, brittle::allFree(room)));
}

// As much as they can be asked for at a time: turns of loops would run out without a word. Half of the owners are refused at
// their last request, so that all else is undone.
TEST(Pools, WalkThroughTheLongestLists) {
    constexpr uint32_t kElements = 4 * POOL_MOST_FREE;
    const PoolRoom room{.capacity = {kElements, kElements, kElements, kElements},
                        .objects = POOL_MOST_FREE - 1,
                        .returned = POOL_MOST_RETURNED,
                        .owners = POOL_MOST_OWNERS,
                        .requests = POOL_MOST_REQUESTS};
    DevicePools device(room, FreeLists{});
    MarkedPools host(room, FreeLists{});
    PoolDemand two_more;
    for (uint32_t first = 0; first < kElements; first += 4 * POOL_MOST_RETURNED) {
        PoolDemand every_fourth;
        for (uint32_t k = 0; k < 4 * POOL_MOST_RETURNED; k += 4)
            every_fourth.returned.push_back(everywhere(kElements - 4 - first - k, 1));
        EXPECT_EQ(device.step(every_fourth), host.step(every_fourth));
    }
    constexpr uint32_t kOfThree = POOL_MOST_RETURNED / 2; // half of them at the start, half at the end
    for (uint32_t k = 0; k < kOfThree; ++k)
        for (const uint32_t beside : {1, 2})
            two_more.returned.push_back(everywhere((k % 2 == 0 ? 2 * k : kElements - 2 - 2 * k) + beside, 1));
    two_more.owners.assign(POOL_MOST_OWNERS, Requests(8, {1, 2, 3, 1}));
    for (uint32_t o = 0; o < POOL_MOST_OWNERS; o += 2)
        two_more.owners[o][7] = {1, 2, 3, 4};
    EXPECT_EQ(device.lists()[0].size(), size_t{POOL_MOST_FREE});
    EXPECT_EQ(device.step(two_more), host.step(two_more));
    expectSame(device, host);
    EXPECT_EQ(device.lists()[2].size(), POOL_MOST_FREE - kOfThree) << "all ranges of three are taken";
    EXPECT_EQ(device.header(3).lacked, POOL_MOST_OWNERS / 2);
}

// A hundred steps of a life that ends with all returned, again and again. Only the first time tells what is taken: from the
// same list, the same is.
TEST(Pools, AreAsTheyBeganAfterTenThousandSteps) {
    const PoolRoom room = smallRoom();
    DevicePools pools(room, brittle::allFree(room));
    PoolLife life(11, 12, 8, {1, 6, 20, 2});
    std::vector<DemandBuffers> steps;
    std::vector<PoolAnswer> answers;
    for (int k = 0; k < 100; ++k) {
        const PoolDemand demand = k == 99 ? life.last() : life.next();
        DemandBuffers& step = steps.emplace_back(demand, room);
        life.note(demand, answers.emplace_back(pools.step(step)));
    }
    engine::Commands commands(engine_test::device());
    ASSERT_TRUE(commands.begin(engine::Commands::Reuse::Many));
    for (DemandBuffers& step : steps)
        step.record(commands, room, pools.buffers(), false);
    for (int again = 0; again < 99; ++again) {
        ASSERT_TRUE(again == 0 ? commands.submit() : commands.submitAgain());
        ASSERT_TRUE(commands.wait());
        ASSERT_EQ(pools.lists(), brittle::allFree(room)) << again;
        for (size_t k = 0; k < steps.size(); ++k)
            ASSERT_EQ(steps[k].answer(), answers[k]) << again;
    }
    for (uint32_t pool = 0; pool < POOLS; ++pool)
        EXPECT_EQ(pools.header(pool).status, 0u);
}

} // namespace kernel_test
