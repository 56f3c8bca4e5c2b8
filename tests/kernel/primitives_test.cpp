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

using SixWords = std::array<uint32_t, 6>;

// Points of six words of which many coincide, and some differ in one word only.
std::vector<SixWords> crowdedPoints(uint32_t count) {
    std::mt19937 random(count);
    std::vector<SixWords> points(count);
    for (SixWords& p : points) {
        p = {7, 7, 7, 7, 7, 7};
        p[random() % 6] = static_cast<uint32_t>(random() % (1 + count / 12));
    }
    return points;
}

TEST(SmallWeldPoints, GivesEveryPointTheLowestIdAtItsPlace) {
    for (const uint32_t n : {1u, 63u, 64u, 65u, 1234u, 50'000u}) {
        const std::vector<SixWords> points = crowdedPoints(n);
        std::map<SixWords, uint32_t> lowest;
        std::vector<uint32_t> expected;
        for (uint32_t k = 0; k < n; ++k)
            expected.push_back(lowest.try_emplace(points[k], k).first->second);
        uint32_t slots = 64;
        while (slots < 2 * n)
            slots *= 2;
        Counts counts;
        const engine::Buffer in = bufferOf(points), table = bufferOf(std::vector<uint32_t>(slots));
        const engine::Buffer at = blankBuffer<uint32_t>(n), welded = blankBuffer<uint32_t>(n);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("weld_points"), n, WeldPush{n, NO_INDEX, slots - 1}, {counts.words, in, table, at});
            commands.dispatch(kernel("resolve_points"), n, LengthPush{n, NO_INDEX}, {counts.words, table, at, welded});
        });
        EXPECT_EQ(valuesOf<uint32_t>(welded, n), expected) << n;
        EXPECT_EQ(counts[STATUS_BAD_WELD], 0u);
    }
}

TEST(SmallWeldPoints, ReportsATableThatIsFull) {
    std::vector<SixWords> points;
    for (uint32_t k = 0; k < 200; ++k)
        points.push_back({k, 0, 0, 0, 0, 0});
    Counts counts;
    const engine::Buffer in = bufferOf(points), table = bufferOf(std::vector<uint32_t>(128)), at = blankBuffer<uint32_t>(200);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("weld_points"), 200, WeldPush{200, NO_INDEX, 127}, {counts.words, in, table, at});
    });
    EXPECT_GT(counts[STATUS_BAD_WELD], 0u);
    EXPECT_EQ(counts[STATUS_FAILED], FAILED_CAPACITY);
}

} // namespace
} // namespace kernel_test
