// scan_reduce and scan_apply against a running sum; the counts and dispatch arguments they publish.
#include "modules/brittle/fracture/known_counts.h"
#include "tests/kernel/lab.h"

#include <random>

namespace kernel_test {
namespace {

constexpr uint32_t kScanSizes[] = {1, 63, 64, 65, 1023, 1024, 1025, 1234, 100'000};

struct ReducePush {
    uint32_t length, length_count;
};

struct ApplyPush {
    uint32_t length, length_count, pad0 = 0, pad1 = 0;
    Word4 published = {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX};
    Word4 capacity = {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX};
};

std::vector<uint32_t> randomWords(size_t count, uint32_t below) {
    std::mt19937 random(static_cast<uint32_t>(count));
    std::vector<uint32_t> words(count);
    for (uint32_t& word : words)
        word = static_cast<uint32_t>(random() % below);
    return words;
}

std::vector<uint32_t> runningSum(const std::vector<uint32_t>& values, size_t channels) {
    std::vector<uint32_t> sums(values.size() + channels, 0);
    for (size_t k = 0; k < values.size(); ++k)
        sums[k + channels] = sums[k] + values[k];
    return sums;
}

// Two-dimensional from 65,536 workgroups on.
std::vector<uint32_t> expectedArgs(uint32_t count) {
    std::vector<uint32_t> args;
    for (const uint32_t per_group : {uint32_t{GROUP_SIZE}, uint32_t{SCAN_BLOCK}, 1u}) {
        const uint32_t groups = (count + per_group - 1) / per_group, rows = (groups + 65534) / 65535;
        args.insert(args.end(), {std::min(groups, 65535u), rows, 1});
    }
    return args;
}

// Scans `values` and returns the offsets, one more than values.
std::vector<uint32_t> scan(const std::vector<uint32_t>& values, uint32_t channels, Counts& counts, const ApplyPush& push) {
    const std::string suffix = channels == 4 ? "4" : "";
    const uint32_t n = static_cast<uint32_t>(values.size()) / channels, blocks = (n + SCAN_BLOCK - 1) / SCAN_BLOCK;
    const engine::Buffer in = bufferOf(values, channels), sums = blankBuffer<uint32_t>(std::max(blocks, 1u) * channels);
    const engine::Buffer out = blankBuffer<uint32_t>((n + 1) * channels);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("scan_reduce" + suffix), blocks, ReducePush{push.length, push.length_count},
                                {counts.words, in, sums});
        commands.dispatchGroups(kernel("scan_apply" + suffix), blocks, push, {counts.words, in, sums, out, counts.args});
    });
    return valuesOf<uint32_t>(out, (n + 1) * channels);
}

TEST(SmallScan, IsTheRunningSum) {
    for (const uint32_t n : kScanSizes) {
        Counts counts;
        const std::vector<uint32_t> values = randomWords(n, 1000);
        EXPECT_EQ(scan(values, 1, counts, {.length = n, .length_count = NO_INDEX}), runningSum(values, 1)) << n;
    }
}

TEST(SmallScan, OfFourChannelsIsFourRunningSums) {
    for (const uint32_t n : kScanSizes) {
        Counts counts;
        const std::vector<uint32_t> values = randomWords(4 * n, 1000);
        EXPECT_EQ(scan(values, 4, counts, {.length = n, .length_count = NO_INDEX}), runningSum(values, 4)) << n;
    }
}

TEST(SmallScan, TakesItsLengthFromACount) {
    Counts counts;
    counts[COUNT_PAIRS] = 1000;
    const std::vector<uint32_t> values = randomWords(1234, 10);
    const std::vector<uint32_t> offsets = scan(values, 1, counts, {.length = 0, .length_count = COUNT_PAIRS});
    const std::vector<uint32_t> expected = runningSum(values, 1);
    EXPECT_TRUE(std::equal(expected.begin(), expected.begin() + 1001, offsets.begin()));
}

TEST(SmallScan, PublishesTotalsAndDispatchArguments) {
    for (const uint32_t n : kScanSizes) {
        Counts counts;
        const std::vector<uint32_t> values = randomWords(4 * n, 1000);
        const ApplyPush push{.length = n, .length_count = NO_INDEX, .published = {3, NO_INDEX, 5, 6}};
        const std::vector<uint32_t> offsets = scan(values, 4, counts, push);
        EXPECT_EQ(counts[3], offsets[4 * n]);
        EXPECT_EQ(counts[4], 0u);
        EXPECT_EQ(counts[5], offsets[4 * n + 2]);
        EXPECT_EQ(counts[6], offsets[4 * n + 3]);
        EXPECT_EQ(counts.argsOf(6), expectedArgs(counts[6]));
        EXPECT_EQ(counts[STATUS_FAILED], 0u);
    }
}

TEST(SmallScan, OfAKnownCountTheHostHasTheSameArguments) {
    for (const uint32_t n : {0u, 1u, 64u, 65u, 1024u, 1025u, 65535u, 65536u, 65535u * 64u, 65535u * 64u + 1u}) {
        Counts counts;
        counts[COUNT_PAIRS] = n;
        onDevice([&](engine::Commands& commands) { counts.publish(commands, COUNT_PAIRS, NO_INDEX); });
        const auto args = brittle::argumentsOf(n, GROUP_SIZE);
        EXPECT_EQ(counts.argsOf(COUNT_PAIRS), std::vector<uint32_t>(args.begin(), args.end())) << n;
    }
}

TEST(SmallScan, ReportsAPoolThatIsTooSmall) {
    for (const uint32_t room : {2000u, 1999u}) {
        Counts counts;
        const std::vector<uint32_t> values(1000, 2);
        scan(values, 1, counts,
             {.length = 1000,
              .length_count = NO_INDEX,
              .published = {7, NO_INDEX, NO_INDEX, NO_INDEX},
              .capacity = {room, 0, 0, 0}});
        const bool fits = room == 2000;
        EXPECT_EQ(counts[STATUS_FAILED], fits ? 0u : FAILED_CAPACITY);
        EXPECT_EQ(counts[STATUS_NEEDED + 7], fits ? 0u : 2000u);
        EXPECT_EQ(counts[7], fits ? 2000u : 0u);
        EXPECT_EQ(counts.argsOf(7), expectedArgs(fits ? 2000u : 0u));
    }
}

// Several at a time may be too small; but what kernels left unwritten after a failure asks for nothing.
TEST(SmallScan, AsksForNoRoomOnceTheEventHasFailed) {
    for (const uint32_t channels : {1u, 4u})
        for (const bool failed : {false, true}) {
            Counts counts;
            counts[STATUS_FAILED] = failed ? FAILED_CAPACITY : 0;
            scan(std::vector<uint32_t>(1000 * channels, 2), channels, counts,
                 {.length = 1000,
                  .length_count = NO_INDEX,
                  .published = {7, 8, NO_INDEX, NO_INDEX},
                  .capacity = {10, 20, 0, 0}});
            EXPECT_EQ(counts[STATUS_NEEDED + 7], failed ? 0u : 2000u);
            EXPECT_EQ(counts[STATUS_NEEDED + 8], failed || channels == 1 ? 0u : 2000u);
            EXPECT_EQ(counts[7], 0u);
        }
}

} // namespace
} // namespace kernel_test
