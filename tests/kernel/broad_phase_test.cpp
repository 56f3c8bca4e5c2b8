// The broad phase against each box held against each: arrangements that are hard on trees, all sizes around the blocks of the
// kernels, what may not be paired, and what does not fit.
#include "tests/kernel/device_boxes.h"

#include <functional>
#include <limits>
#include <random>

namespace kernel_test {
namespace {

constexpr uint32_t kBoxCounts[] = {0, 1, 2, 63, 64, 65, 255, 256, 257, 1000, 1024, 1025};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Corners that floats can hold: what the device is given is what the reference is given.
double rounded(double x) { return static_cast<double>(static_cast<float>(x)); }

reference::SolidBox cube(const std::array<double, 3>& center, double half, uint32_t body) {
    reference::SolidBox box;
    for (size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = rounded(center[axis] - half);
        box.high[axis] = rounded(center[axis] + half);
    }
    box.body = body;
    return box;
}

class Dice {
public:
    explicit Dice(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0); }
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(random_() % end); }

private:
    std::mt19937 random_;
};

// As densely as hulls of half a meter lie in a heap.
Boxes heap(uint32_t count) {
    Dice dice(count);
    const double edge = std::cbrt(0.42 * count);
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k)
        boxes.push_back(
            cube({dice.between(0, edge), dice.between(0, edge), dice.between(0, edge)}, dice.between(0.3, 0.52), k));
    return boxes;
}

Boxes clusters(uint32_t count) {
    Dice dice(count);
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k) {
        const double place = 100.0 * dice.below(1 + count / 20);
        boxes.push_back(cube({place + dice.between(0, 1), -place, dice.between(0, 1)}, dice.between(0.01, 0.2), k));
    }
    return boxes;
}

Boxes identical(uint32_t count) {
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k)
        boxes.push_back(cube({1, 2, 3}, 0.5, k));
    return boxes;
}

// One center: flat ones in three directions, most of which meet.
Boxes coincident(uint32_t count) {
    Dice dice(count);
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k) {
        boxes.push_back(cube({0, 0, 0}, dice.between(0.1, 1), k));
        boxes.back().low[k % 3] = boxes.back().high[k % 3] = k % 7 == 0 ? 0.25 : 0;
    }
    return boxes;
}

// One in the other, in steps of a thousandth from a millimeter to a few meters.
Boxes nested(uint32_t count) {
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k)
        boxes.push_back(cube({0, 0, 0}, 0.001 * (1 + (k * 37u) % count), k));
    return boxes;
}

// Each touches the next two exactly.
Boxes line(uint32_t count) {
    Boxes boxes;
    for (uint32_t k = 0; k < count; ++k)
        boxes.push_back(cube({static_cast<double>(k), 0, 0}, 1, k));
    return boxes;
}

Boxes oneFarAway(uint32_t count) {
    Dice dice(count);
    Boxes boxes;
    const double half = 0.5 / std::cbrt(1.0 + count);
    for (uint32_t k = 0; k < count; ++k)
        boxes.push_back(cube({dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)}, half, k));
    if (count > 0) boxes[count / 2] = cube({10'000, 0, 0}, 0.5, count / 2);
    return boxes;
}

// A slab below a heap, fixed or not, first, last or in the middle.
Boxes oneHuge(uint32_t count) {
    Boxes boxes = heap(count);
    if (count == 0) return boxes;
    const std::array<uint32_t, 3> places = {0, count - 1, count / 2};
    const uint32_t at = places[count % 3];
    boxes[at].low = {-100, -1, -100};
    boxes[at].high = {100, 1, 100};
    boxes[at].fixed = count % 2 == 0;
    return boxes;
}

// Free slots, pieces of common bodies and some that do not move.
Boxes mixed(uint32_t count) {
    Dice dice(count + 1);
    Boxes boxes = heap(count);
    for (reference::SolidBox& box : boxes) {
        box.body = box.body / (1 + dice.below(6));
        box.fixed = dice.below(4) == 0;
        box.absent = dice.below(10) == 0;
    }
    return boxes;
}

// Boxes without bounds, inside out, without numbers, without extent and at the end of all numbers.
Boxes strange(uint32_t count) {
    Dice dice(count);
    Boxes boxes = heap(count);
    const double nan = std::numeric_limits<double>::quiet_NaN(), greatest = std::numeric_limits<float>::max();
    for (uint32_t k = 0; k < count; ++k) {
        reference::SolidBox& box = boxes[k];
        const uint32_t axis = dice.below(3);
        switch (dice.below(12)) {
        case 0: box.low[axis] = nan; break;
        case 1: box.high[axis] = nan; break;
        case 2: std::swap(box.low[axis], box.high[axis]); break;
        case 3: box.high = box.low; break;
        case 4: box.absent = true; break;
        default: break;
        }
        if (k % 61 == 5) box.low = {-kInfinity, -kInfinity, 0}, box.high = {kInfinity, kInfinity, 0};
        if (k % 61 == 6) box.low = {greatest, greatest, 0}, box.high = {greatest, greatest, 0.5};
    }
    return boxes;
}

struct Arrangement {
    const char* name;
    std::function<Boxes(uint32_t)> make;
};

const std::vector<Arrangement>& arrangements() {
    static const std::vector<Arrangement> kAll = {
        {"heap", heap},     {"clusters", clusters}, {"identical", identical},     {"coincident", coincident},
        {"nested", nested}, {"line", line},         {"one far away", oneFarAway}, {"one huge", oneHuge},
        {"mixed", mixed},   {"strange", strange},
    };
    return kAll;
}

void expectAllPairs(const Boxes& boxes, BroadPhaseRun run, const std::string& what) {
    const Pairs expected = reference::pairsThatMeet(boxes);
    run.pair_capacity = static_cast<uint32_t>(expected.size()) + 1;
    const FoundPairs found = pairsOnDevice(boxes, run);
    EXPECT_EQ(found.failed, 0u) << what;
    EXPECT_TRUE(found.pairs == expected) << what << ": " << found.pairs.size() << " pairs of " << expected.size();
}

} // namespace

TEST(SmallBroadPhase, FindsAllPairsInOrder) {
    for (const Arrangement& arrangement : arrangements())
        for (const uint32_t count : kBoxCounts)
            expectAllPairs(arrangement.make(count), {}, arrangement.name + std::string(" of ") + std::to_string(count));
}

TEST(SmallBroadPhase, FindsTheSameByEitherSort) {
    for (const Arrangement& arrangement : arrangements())
        for (const uint32_t count : {257u, 1000u})
            expectAllPairs(arrangement.make(count), {.sort = brittle::BoxSort::ManyGroups},
                           arrangement.name + std::string(" of ") + std::to_string(count));
}

// There is room for more boxes than there are, as in a world in which things will break.
TEST(SmallBroadPhase, TakesTheNumberOfBoxesFromTheDevice) {
    for (const brittle::BoxSort sort : {brittle::BoxSort::OneGroup, brittle::BoxSort::ManyGroups})
        for (const uint32_t count : {0u, 100u, 256u, 257u, 1000u})
            expectAllPairs(heap(count), {.box_capacity = 3001, .sort = sort}, std::to_string(count));
}

TEST(BroadPhase, FindsAllPairsAmongManyBoxes) {
    expectAllPairs(heap(10'000), {}, "a heap");
    expectAllPairs(oneHuge(6000), {}, "a slab below a heap");
    expectAllPairs(mixed(5000), {}, "mixed");
    expectAllPairs(nested(1500), {}, "nested");
}

// Ten thousand in a cubic meter and one ten kilometers away.
TEST(BroadPhase, FindsAllPairsOfACrowdWithOneFarAway) { expectAllPairs(oneFarAway(10'001), {}, "one far away"); }

TEST(BroadPhase, FindsAllPairsOfALargeBoxThatMoves) {
    Boxes boxes = heap(5000);
    boxes[4321].low = {-100, -100, -100};
    boxes[4321].high = {100, 100, 100};
    expectAllPairs(boxes, {}, "a large box");
    const Pairs pairs = reference::pairsThatMeet(boxes);
    EXPECT_GE(pairs.size(), 4999u);
}

TEST(SmallBroadPhase, SaysHowManyPairsThereWouldHaveBeen) {
    for (const uint32_t count : {200u, 1000u}) {
        const Boxes boxes = heap(count);
        const auto pairs = static_cast<uint32_t>(reference::pairsThatMeet(boxes).size());
        const FoundPairs fits = pairsOnDevice(boxes, {.pair_capacity = pairs});
        EXPECT_EQ(fits.pairs.size(), pairs);
        EXPECT_EQ(fits.failed, 0u);
        for (const uint32_t room : {pairs - 1, pairs / 3, 1u}) {
            const FoundPairs found = pairsOnDevice(boxes, {.pair_capacity = room});
            EXPECT_EQ(found.failed, FAILED_CAPACITY);
            EXPECT_EQ(found.needed_pairs, pairs);
            EXPECT_TRUE(found.pairs.empty());
        }
    }
}

TEST(SmallBroadPhase, SaysHowManyBoxesThereWouldHaveBeen) {
    for (const uint32_t count : {200u, 1000u}) {
        const FoundPairs found = pairsOnDevice(heap(count), {.box_capacity = count - 1});
        EXPECT_EQ(found.failed, FAILED_CAPACITY);
        EXPECT_EQ(found.needed_boxes, count);
        EXPECT_TRUE(found.pairs.empty());
    }
}

TEST(SmallBroadPhase, FindsNothingInAStepThatHasFailed) {
    for (const uint32_t count : {200u, 1000u}) {
        const FoundPairs found = pairsOnDevice(heap(count), {.failed_before = FAILED_CAPACITY});
        EXPECT_TRUE(found.pairs.empty());
        EXPECT_EQ(found.args, (std::vector<uint32_t>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
    }
}

TEST(SmallBroadPhase, PublishesPairsForTheKernelsThatFollow) {
    for (const uint32_t count : {200u, 1000u}) {
        const FoundPairs found = pairsOnDevice(heap(count));
        const auto pairs = static_cast<uint32_t>(found.pairs.size());
        const auto groups = [&](uint32_t size) { return (pairs + size - 1) / size; };
        EXPECT_EQ(found.args, (std::vector<uint32_t>{groups(GROUP_SIZE), 1, 1, groups(SCAN_BLOCK), 1, 1, pairs, 1, 1}));
    }
}

TEST(BroadPhase, WritesTheSameBytesForWorkgroupsOfAnySizeAndEveryTime) {
    const Boxes boxes = oneHuge(3000);
    const Pairs pairs = pairsOnDevice(boxes).pairs;
    EXPECT_EQ(pairs.size(), reference::pairsThatMeet(boxes).size());
    for (const uint32_t size : {8u, 32u, 256u}) {
        engine::KernelLibrary library(engine_test::device(), shaders::all(), {{FLAT_SIZE_ID, size}});
        for (const brittle::BoxSort sort : {brittle::BoxSort::OneGroup, brittle::BoxSort::ManyGroups})
            EXPECT_TRUE(pairsOnDevice(boxes, {.sort = sort, .library = &library}).pairs == pairs) << size;
    }
}

TEST(SmallBroadPhase, RefusesBudgetsThatItCannotServe) {
    auto arena = engine::ScratchArena::create(engine_test::device(), 1 << 20);
    ASSERT_TRUE(arena);
    const auto error = [&](const brittle::BroadPhaseBudget& budget) {
        const auto scratch = brittle::layOutBroadPhase(*arena, budget);
        return scratch ? std::string() : scratch.error().message;
    };
    EXPECT_NE(error({0, 10}).find("no boxes"), std::string::npos);
    EXPECT_NE(error({10, 0}).find("no pairs"), std::string::npos);
    EXPECT_NE(error({brittle::kMostGroupSorted + 1, 10}).find("ManyGroups"), std::string::npos);
    EXPECT_NE(error({brittle::kMostBoxes + 1, 10, brittle::BoxSort::ManyGroups}).find("262144"), std::string::npos);
    EXPECT_NE(error({100'000, 1'000'000}), ""); // more than the arena holds
}

// What broadPhaseBytes() promises, with every range on a boundary of its own.
TEST(SmallBroadPhase, FitsIntoTheArenaThatWasPlannedForIt) {
    for (const brittle::BoxSort sort : {brittle::BoxSort::OneGroup, brittle::BoxSort::ManyGroups})
        for (const uint32_t boxes : {257u, 1025u, 20'000u})
            for (const uint32_t pairs : {1u, 1000u, 100'000u}) {
                const brittle::BroadPhaseBudget budget = {boxes, pairs, sort};
                auto arena = engine::ScratchArena::create(engine_test::device(), brittle::broadPhaseBytes(budget));
                ASSERT_TRUE(arena);
                EXPECT_TRUE(brittle::layOutBroadPhase(*arena, budget)) << boxes << " " << pairs;
            }
}

} // namespace kernel_test
