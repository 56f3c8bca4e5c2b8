// compact, weld_points and resolve_points against plain loops.
#include "tests/kernel/lab.h"

#include <map>
#include <random>

namespace kernel_test {
namespace {

struct LengthPush {
    uint32_t length, length_count;
};

TEST(SmallCompact, ListsTheFlaggedInOrder) {
    for (const uint32_t n : kSizes) {
        std::mt19937 random(n);
        std::vector<uint32_t> offsets = {0}, expected;
        for (uint32_t k = 0; k < n; ++k) {
            const bool flagged = random() % 3 == 0;
            if (flagged) expected.push_back(k);
            offsets.push_back(offsets.back() + flagged);
        }
        Counts counts;
        const engine::Buffer in = bufferOf(offsets), list = blankBuffer<uint32_t>(n);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("compact"), n, LengthPush{n, NO_INDEX}, {counts.words, in, list});
        });
        EXPECT_EQ(valuesOf<uint32_t>(list, expected.size()), expected) << n;
    }
}

struct WeldPush {
    uint32_t length, length_count, table_mask;
};

constexpr uint32_t kMinusZero = 0x80000000;
using Place = std::array<uint32_t, 4>; // the last word is none of it

// Points of which many coincide, some differ in one word only, and some in the sign of a zero.
std::vector<Place> crowdedPoints(uint32_t count) {
    std::mt19937 random(count);
    std::vector<Place> points(count);
    for (Place& p : points) {
        p = {7, 7, 7, static_cast<uint32_t>(random())};
        p[random() % 3] = static_cast<uint32_t>(random() % (1 + count / 6));
    }
    return points;
}

TEST(SmallWeldPoints, GivesEveryPointTheLowestIdAtItsPlace) {
    for (const uint32_t n : {1u, 63u, 64u, 65u, 1234u, 50'000u}) {
        std::vector<Place> points = crowdedPoints(n);
        std::map<std::array<uint32_t, 3>, uint32_t> lowest;
        std::vector<uint32_t> expected, expected_shared(n, 0);
        for (uint32_t k = 0; k < n; ++k) {
            expected.push_back(lowest.try_emplace({points[k][0], points[k][1], points[k][2]}, k).first->second);
            if (expected[k] != k) expected_shared[expected[k]] = 1;
        }
        std::mt19937 random(n);
        for (Place& p : points)
            for (uint32_t& word : p)
                if (word == 0 && random() % 2 == 0) word = kMinusZero;
        uint32_t slots = 64;
        while (slots < 2 * n)
            slots *= 2;
        Counts counts;
        const engine::Buffer in = bufferOf(points), table = bufferOf(std::vector<uint32_t>(slots));
        const engine::Buffer at = blankBuffer<uint32_t>(n), welded = blankBuffer<uint32_t>(n);
        const engine::Buffer shared = bufferOf(std::vector<uint32_t>(n)), itself = bufferOf(countUp(n));
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("weld_positions"), n, WeldPush{n, NO_INDEX, slots - 1},
                              {counts.words, in, table, at, itself});
            commands.dispatch(kernel("resolve_points"), n, LengthPush{n, NO_INDEX}, {counts.words, table, at, welded, shared});
        });
        EXPECT_EQ(valuesOf<uint32_t>(welded, n), expected) << n;
        EXPECT_EQ(valuesOf<uint32_t>(shared, n), expected_shared) << n;
        EXPECT_EQ(counts[STATUS_BAD_WELD], 0u);
    }
}

TEST(SmallWeldPoints, ReportsATableThatIsFull) {
    std::vector<Place> points;
    for (uint32_t k = 0; k < 200; ++k)
        points.push_back({k, 0, 0, 0});
    Counts counts;
    const engine::Buffer in = bufferOf(points), table = bufferOf(std::vector<uint32_t>(128)), at = blankBuffer<uint32_t>(200);
    const engine::Buffer itself = bufferOf(countUp(200));
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("weld_positions"), 200, WeldPush{200, NO_INDEX, 127}, {counts.words, in, table, at, itself});
    });
    EXPECT_GT(counts[STATUS_BAD_WELD], 0u);
    EXPECT_EQ(counts[STATUS_FAILED], FAILED_CAPACITY);
}

} // namespace
} // namespace kernel_test
