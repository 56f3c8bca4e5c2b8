// The kernels of the broad phase one by one: keys along the curve, their sort, the tree over them, and long and short lists of
// pairs.
#include "tests/kernel/device_boxes.h"

#include <algorithm>
#include <bit>
#include <random>

namespace kernel_test {
namespace {

reference::SolidBox cubeAt(double x, double y, double z, double half, uint32_t body) {
    return {{x - half, y - half, z - half}, {x + half, y + half, z + half}, body};
}

// The k-th of a grid with so many a row and a layer.
reference::SolidBox inGrid(uint32_t k, uint32_t side, double half) {
    const uint32_t row = k / side % side, layer = k / (side * side);
    return cubeAt(k % side, row, layer, half, k);
}

// Keys as one number each: the class of a box on top.
std::vector<uint64_t> keysOf(const Boxes& boxes) {
    const auto count = static_cast<uint32_t>(boxes.size());
    Counts counts;
    counts[COUNT_TREE_BOXES] = count;
    const DeviceBoxes in = upload(boxes, 1);
    const engine::Buffer extent = bufferOf(std::vector<uint32_t>(EXTENT_WORDS));
    const engine::Buffer low = blankBuffer<uint32_t>(count), high = blankBuffer<uint32_t>(count);
    const engine::Buffer order = blankBuffer<uint32_t>(count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("measure_boxes"), (count + SCAN_BLOCK - 1) / SCAN_BLOCK, engine::NoPush{},
                                {counts.words, in.low, in.high, extent});
        commands.dispatch(kernel("key_boxes"), count, engine::NoPush{},
                          {counts.words, in.low, in.high, extent, low, high, order});
    });
    EXPECT_EQ(valuesOf<uint32_t>(order, count), countUp(count));
    std::vector<uint64_t> keys;
    for (uint32_t k = 0; k < count; ++k)
        keys.push_back((uint64_t{high.mappedAs<uint32_t>()[k]} << 32) | low.mappedAs<uint32_t>()[k]);
    return keys;
}

} // namespace

TEST(SmallBoxKeys, WalkThroughACubeFromNeighborToNeighbor) {
    constexpr uint32_t kSide = 16;
    Boxes boxes;
    for (uint32_t k = 0; k < kSide * kSide * kSide; ++k)
        boxes.push_back(inGrid(k, kSide, 0.25));
    const std::vector<uint64_t> keys = keysOf(boxes);
    std::vector<uint32_t> order = countUp(boxes.size());
    std::ranges::sort(order, {}, [&](uint32_t k) { return keys[k]; });
    for (size_t k = 1; k < order.size(); ++k) {
        double way = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            way += std::abs(boxes[order[k]].low[axis] - boxes[order[k - 1]].low[axis]);
        EXPECT_EQ(way, 1) << k;
    }
}

TEST(SmallBoxKeys, PutWhatOnlyIsFoundBehindWhatAsks) {
    Boxes boxes;
    for (uint32_t k = 0; k < 2000; ++k)
        boxes.push_back(inGrid(k, 50, 0.5));
    std::vector<uint64_t> expected(2000, CLASS_MOVING);
    boxes[77] = cubeAt(0, 0, 0, 40, 77);
    expected[77] = CLASS_LARGE;
    boxes[78] = cubeAt(0, 0, 0, 40, 78);
    boxes[78].fixed = true;
    boxes[1111].fixed = true;
    expected[78] = expected[1111] = CLASS_STATIC;
    boxes[5].absent = boxes[1112].absent = boxes[1112].fixed = true;
    std::swap(boxes[6].low[1], boxes[6].high[1]);
    expected[5] = expected[6] = expected[1112] = CLASS_ABSENT;
    std::vector<uint64_t> classes = keysOf(boxes);
    for (uint64_t& key : classes)
        key >>= 32 + KEY_LOW_BITS;
    EXPECT_EQ(classes, expected);
}

TEST(SmallSortBoxes, SortsByBothWordsAndKeepsTheOrderOfEqualKeys) {
    for (const uint32_t n : {1u, 63u, 64u, 65u, 1234u, 30'000u}) {
        std::mt19937 random(n);
        std::vector<uint32_t> low(n), high(n), expected = countUp(n), order = expected;
        for (uint32_t k = 0; k < n; ++k) { // many are equal in one word or both
            low[k] = static_cast<uint32_t>(random() >> 2) >> random() % 30;
            high[k] = static_cast<uint32_t>(random()) & (random() % 2 == 0 ? 0xc0000007u : 0xf800001fu);
        }
        std::ranges::stable_sort(expected, {}, [&](uint32_t k) { return uint64_t{high[k]} << 32 | low[k]; });
        Counts counts;
        counts[COUNT_TREE_BOXES] = n;
        const uint32_t room = n + 5;
        order.resize(2 * size_t{room});
        const engine::Buffer low_words = bufferOf(low), high_words = bufferOf(high), list = bufferOf(order);
        onDevice([&](engine::Commands& commands) {
            commands.dispatchGroups(kernel("sort_boxes"), 1, room, {counts.words, low_words, high_words, list});
        });
        const std::vector<uint32_t> halves = valuesOf<uint32_t>(list, 2 * size_t{room});
        constexpr uint32_t kDigits =
            (KEY_LOW_BITS + GROUP_SORT_BITS - 1) / GROUP_SORT_BITS + (KEY_HIGH_BITS + GROUP_SORT_BITS - 1) / GROUP_SORT_BITS;
        const size_t first = kDigits % 2 != 0 ? room : 0;
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), halves.begin() + static_cast<std::ptrdiff_t>(first))) << n;
    }
}

TEST(SmallGatherWords, FollowsTheList) {
    const std::vector<uint32_t> words = {10, 11, 12, 13, 14}, list = {4, 0, 0, 2};
    Counts counts;
    counts[COUNT_TREE_BOXES] = 4;
    const engine::Buffer from = bufferOf(words), through = bufferOf(list), to = blankBuffer<uint32_t>(5);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("gather_words"), 5, uint32_t{COUNT_TREE_BOXES}, {counts.words, from, through, to});
    });
    EXPECT_EQ(valuesOf<uint32_t>(to, 5), (std::vector<uint32_t>{14, 10, 10, 12, 0xcdcdcdcd}));
}

namespace {

struct Node {
    std::array<float, 3> low, high;
    uint32_t body;
    bool operator==(const Node&) const = default;
};

// As many boxes as there are leaves, those of a few bodies next to each other, in an order that is not theirs.
struct Leaves {
    Boxes boxes;
    std::vector<uint32_t> order;
    const reference::SolidBox& operator[](uint32_t leaf) const { return boxes[order[leaf]]; }
};

Leaves someLeaves(uint32_t count) {
    std::mt19937 random(count);
    Leaves leaves;
    leaves.order = countUp(count);
    std::ranges::shuffle(leaves.order, random);
    leaves.boxes.resize(count);
    const auto number = [&] { return static_cast<double>(random() % 1024) / 64; };
    for (uint32_t leaf = 0; leaf < count; ++leaf) {
        leaves.boxes[leaves.order[leaf]] = cubeAt(number(), number(), number(), number(), leaf / 70);
        leaves.boxes[leaves.order[leaf]].absent = random() % 8 == 0;
    }
    return leaves;
}

// All that is there among the leaves from `first` to `last`; nothing is from plus to minus infinity.
Node boxAround(const Leaves& leaves, uint32_t first, uint32_t last) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Node all = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}, NO_BODY};
    bool any = false;
    for (uint32_t leaf = first; leaf <= last; ++leaf) {
        const reference::SolidBox& box = leaves[leaf];
        if (box.absent) continue;
        for (size_t axis = 0; axis < 3; ++axis) {
            all.low[axis] = std::min(all.low[axis], static_cast<float>(box.low[axis]));
            all.high[axis] = std::max(all.high[axis], static_cast<float>(box.high[axis]));
        }
        all.body = !any || all.body == box.body ? box.body : NO_BODY;
        any = true;
    }
    return all;
}

std::vector<Word4> nodesOver(const Leaves& leaves, uint32_t room) {
    const auto count = static_cast<uint32_t>(leaves.boxes.size());
    Counts counts;
    counts[COUNT_TREE_BOXES] = count;
    const DeviceBoxes in = upload(leaves.boxes, 1);
    const engine::Buffer order = bufferOf(leaves.order), nodes = blankBuffer<Word4>(4 * room + 4);
    onDevice([&](engine::Commands& commands) {
        const uint32_t blocks = (count + JOIN_BLOCK - 1) / JOIN_BLOCK;
        struct Push {
            uint32_t box_capacity, base, order_first;
        } first = {room, 0, 0}, second = {room, JOIN_BITS, 0};
        commands.dispatchGroups(kernel("join_boxes"), blocks, first, {counts.words, in.low, in.high, order, nodes});
        commands.dispatchGroups(kernel("join_boxes"), 1, second, {counts.words, in.low, in.high, order, nodes});
    });
    return valuesOf<Word4>(nodes, 4 * room + 4);
}

Node nodeFrom(const std::vector<Word4>& nodes, size_t at) {
    const Word4 &low = nodes[2 * at], &high = nodes[2 * at + 1];
    Node node = {{}, {}, low[3]};
    for (size_t axis = 0; axis < 3; ++axis) {
        node.low[axis] = std::bit_cast<float>(low[axis]);
        node.high[axis] = std::bit_cast<float>(high[axis]);
    }
    return node;
}

} // namespace

TEST(SmallJoinBoxes, MakesEveryNodeThatAWalkToTheRightMayMeet) {
    for (const uint32_t count : {2u, 63u, 64u, 65u, 1023u, 1024u, 1025u, 4097u, 20'000u}) {
        const Leaves leaves = someLeaves(count);
        const uint32_t room = count + count % 3;
        const std::vector<Word4> nodes = nodesOver(leaves, room);
        for (uint32_t p = 0; p < count; ++p) {
            EXPECT_EQ(nodes[2 * p + 1][3], leaves.order[p]);
            EXPECT_EQ(nodeFrom(nodes, p), boxAround(leaves, p, p)) << count << " " << p;
            for (uint32_t level = 2; p > 0 && p % (1u << level) == 0; level += 2) {
                const uint32_t last = std::min(p + (1u << level), count) - 1, at = room + 2 * (p / 4) + (1u << (level - 2)) - 1;
                EXPECT_EQ(nodeFrom(nodes, at), boxAround(leaves, p, last)) << count << " " << p << " " << level;
            }
        }
    }
}

// Boxes that all meet: the first meets 299 others and the nodes above them.
TEST(SmallPairBoxes, SaysWhereALaneRanOutOfTurns) {
    constexpr uint32_t kBoxes = 300, kPairs = kBoxes * (kBoxes - 1) / 2;
    Leaves leaves;
    leaves.order = countUp(kBoxes);
    for (uint32_t k = 0; k < kBoxes; ++k)
        leaves.boxes.push_back(cubeAt(0, 0, 0, 1, k));
    const engine::Buffer nodes = bufferOf(nodesOver(leaves, kBoxes));
    for (const uint32_t turns : {100u, 299u, 500u}) {
        Counts counts;
        counts[COUNT_TREE_BOXES] = kBoxes;
        const DeviceBoxes in = upload(leaves.boxes, 1);
        const engine::Buffer pair_counts = bufferOf(std::vector<uint32_t>(kBoxes)), found = blankBuffer<uint32_t>(3 * kPairs);
        struct Push {
            uint32_t box_capacity, pair_capacity, turn_budget;
        } push = {kBoxes, kPairs, turns};
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("pair_boxes"), kBoxes, push, {counts.words, nodes, in.high, pair_counts, found});
        });
        EXPECT_EQ(counts[STATUS_FAILED], turns == 500 ? 0u : FAILED_PAIRING) << turns;
        if (turns == 500) {
            EXPECT_EQ(counts[COUNT_FOUND_PAIRS], kPairs);
        }
    }
}

// Lists around the length from which they are long, of pieces that lie near each other and in several bitmaps.
TEST(SmallOrderPairs, PutsShortAndLongListsInOrder) {
    constexpr uint32_t kPieces = 200'000;
    std::mt19937 random(5);
    std::vector<uint32_t> offsets(kPieces + 1, 0), long_lists;
    std::vector<Word2> loose, expected;
    uint32_t a = 0;
    for (const uint32_t length : {1u, 2u, 63u, 64u, 65u, 300u, 1u, 5000u, 64u, 65u}) {
        const uint32_t spread = length == 65 ? 100 : kPieces - a - 1;
        std::vector<uint32_t> partners(spread);
        std::iota(partners.begin(), partners.end(), a + 1);
        std::ranges::shuffle(partners, random);
        partners.resize(length);
        offsets[a] = static_cast<uint32_t>(loose.size());
        offsets[a + 1] = offsets[a] + length;
        if (length > LONG_LIST) long_lists.insert(long_lists.begin(), a);
        for (const uint32_t b : partners)
            loose.push_back({a, b});
        a += 2;
    }
    expected = loose;
    std::ranges::sort(expected);
    Counts counts;
    counts[COUNT_TREE_BOXES] = kPieces;
    counts[COUNT_TREE_PAIRS] = static_cast<uint32_t>(loose.size());
    counts[COUNT_LONG_LISTS] = static_cast<uint32_t>(long_lists.size());
    const engine::Buffer begins = bufferOf(offsets), in = bufferOf(loose), lists = bufferOf(long_lists);
    const engine::Buffer out = blankBuffer<Word2>(loose.size());
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("order_pairs"), counts[COUNT_TREE_PAIRS], engine::NoPush{}, {counts.words, begins, in, out});
        commands.dispatchGroups(kernel("order_long_lists"), counts[COUNT_LONG_LISTS], engine::NoPush{},
                                {counts.words, begins, in, lists, out});
    });
    EXPECT_TRUE(valuesOf<Word2>(out, loose.size()) == expected);
}

} // namespace kernel_test
