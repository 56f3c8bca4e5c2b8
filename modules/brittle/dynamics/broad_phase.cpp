#include "modules/brittle/dynamics/broad_phase.h"

#include <algorithm>
#include <string>

namespace brittle {
namespace {

static_assert(COUNT_LONG_LISTS < COUNT_RADIX, "the radix sort has a count of its own");
static_assert(LONG_LIST < MOST_TURNS && FEW_BOXES % 32 == 0 && JOIN_BLOCK == SCAN_BLOCK && 1 << JOIN_BITS == JOIN_BLOCK);
static_assert(kMostBoxes <= 1u << (2 * JOIN_BITS), "two dispatches make the tree");

constexpr uint32_t digitsOf(uint32_t bits) { return (bits + GROUP_SORT_BITS - 1) / GROUP_SORT_BITS; }

constexpr Length kBoxes = Length{0, COUNT_TREE_BOXES};
constexpr Length kTreePairs = Length{0, COUNT_TREE_PAIRS};

uint64_t blocksOf(uint64_t n) { return (n + SCAN_BLOCK - 1) / SCAN_BLOCK; }

// Words of a histogram over the tiles of a list.
uint64_t histogramOf(uint64_t n) { return ((n + RADIX_TILE - 1) / RADIX_TILE) << RADIX_BITS; }

// Where the order begins in its list, whose halves take turns.
uint32_t orderFirst(const BroadPhaseBudget& budget) {
    const bool second_half = (digitsOf(KEY_LOW_BITS) + digitsOf(KEY_HIGH_BITS)) % 2 != 0;
    return budget.sort == BoxSort::OneGroup && second_half ? budget.boxes : 0;
}

// The low words first, then, stably, the high ones.
void recordRadixSort(Recorder& r, const BroadPhaseScratch& s) {
    const RadixBuffers room = {s.histogram, s.digit_offsets, s.sums};
    r.sort(COUNT_TREE_BOXES, KEY_LOW_BITS, {s.key_low, s.other_keys}, {s.order, s.other_order}, room);
    r.run("gather_words", kBoxes, uint32_t{COUNT_TREE_BOXES}, {r.counts(), s.key_high, s.order, s.sort_keys});
    r.sort(COUNT_TREE_BOXES, KEY_HIGH_BITS, {s.sort_keys, s.other_keys}, {s.order, s.other_order}, room);
}

void recordOrder(Recorder& r, const BroadPhase& p) {
    const auto& s = p.scratch;
    r.clear({s.extent});
    r.runGroups("measure_boxes", r.blocksOf(COUNT_TREE_BOXES), engine::NoPush{}, {r.counts(), p.box_low, p.box_high, s.extent});
    r.run("key_boxes", kBoxes, engine::NoPush{}, {r.counts(), p.box_low, p.box_high, s.extent, s.key_low, s.key_high, s.order});
    if (p.budget.sort == BoxSort::OneGroup)
        r.runGroups("sort_boxes", 1, p.budget.boxes, {r.counts(), s.key_low, s.key_high, s.order});
    else
        recordRadixSort(r, s);
}

void recordTree(Recorder& r, const BroadPhase& p) {
    const auto& s = p.scratch;
    struct Push {
        uint32_t box_capacity, base, order_first;
    } leaves = {p.budget.boxes, 0, orderFirst(p.budget)}, blocks = {p.budget.boxes, JOIN_BITS, 0};
    r.runGroups("join_boxes", r.blocksOf(COUNT_TREE_BOXES), leaves, {r.counts(), p.box_low, p.box_high, s.order, s.nodes});
    if (p.budget.boxes > JOIN_BLOCK)
        r.runGroups("join_boxes", 1, blocks, {r.counts(), p.box_low, p.box_high, s.order, s.nodes});
}

// Pairs in any order, and how many each piece comes first in.
void recordSearch(Recorder& r, const BroadPhase& p) {
    const auto& s = p.scratch;
    r.clear({s.pair_counts});
    struct Push {
        uint32_t box_capacity, pair_capacity, turn_budget;
    } push = {p.budget.boxes, p.budget.pairs,
              std::min(MOST_TURNS, 0xffffffffu / p.budget.boxes)}; // so that no sum of pairs wraps around
    r.run("pair_boxes", kBoxes, push, {r.counts(), s.nodes, p.box_high, s.pair_counts, s.found_pairs});
    r.scan(kBoxes, s.pair_counts, s.sums, s.pair_offsets,
           {{COUNT_TREE_PAIRS, NO_INDEX, NO_INDEX, NO_INDEX}, {p.budget.pairs, 0, 0, 0}});
}

void recordPairOrder(Recorder& r, const BroadPhase& p) {
    const auto& s = p.scratch;
    r.run("place_pairs", kTreePairs, engine::NoPush{},
          {r.counts(), s.found_pairs, s.pair_offsets, s.loose_pairs, s.long_lists});
    r.runGroups("publish_pairs", 1, engine::NoPush{}, {r.counts(), r.args()});
    r.run("order_pairs", kTreePairs, engine::NoPush{}, {r.counts(), s.pair_offsets, s.loose_pairs, p.pairs});
    r.runGroups("order_long_lists", r.groupsOf(COUNT_LONG_LISTS), engine::NoPush{},
                {r.counts(), s.pair_offsets, s.loose_pairs, s.long_lists, p.pairs});
}

bool needsTree(const BroadPhaseBudget& budget) { return budget.boxes > FEW_BOXES; }

engine::Result<void> check(const BroadPhaseBudget& budget) {
    const uint32_t most = budget.sort == BoxSort::OneGroup ? kMostGroupSorted : kMostBoxes;
    if (budget.boxes == 0 || budget.pairs == 0)
        return engine::Error{engine::ErrorCode::BadInput,
                             "a broad phase with room for no boxes or no pairs: give it room for at least one"};
    if (budget.boxes > most)
        return engine::Error{engine::ErrorCode::Capacity,
                             "a broad phase of " + std::to_string(budget.boxes) + " boxes, but at most " +
                                 std::to_string(most) + " can be sorted" +
                                 (most < kMostBoxes ? " by one workgroup: use BoxSort::ManyGroups" : "")};
    return {};
}

} // namespace

uint64_t broadPhaseBytes(const BroadPhaseBudget& budget) {
    if (!needsTree(budget)) return 0;
    const uint64_t words = budget.boxes * uint64_t{27} + budget.pairs * uint64_t{6} + 2 * histogramOf(budget.boxes);
    return 4 * words + 4 * blocksOf(histogramOf(budget.boxes)) + 32 * uint64_t{1024};
}

engine::Result<BroadPhaseScratch> layOutBroadPhase(engine::ScratchArena& arena, const BroadPhaseBudget& budget) {
    if (const auto checked = check(budget); !checked) return checked.error();
    BroadPhaseScratch s;
    if (!needsTree(budget)) return s;
    const uint64_t n = budget.boxes, pairs = budget.pairs, histogram = histogramOf(n);
    const auto words = [&](uint64_t count) { return arena.take(4 * count); };
    s.extent = words(EXTENT_WORDS);
    for (engine::BufferView* view : {&s.key_low, &s.key_high, &s.pair_counts})
        *view = words(n);
    s.order = words(2 * n);
    s.nodes = words(16 * n + 16); // two for a leaf (lib/box_tree.glsl), of eight words
    s.pair_offsets = words(n + 1);
    s.sums = words(std::max(blocksOf(n), blocksOf(histogram)));
    s.found_pairs = words(3 * pairs);
    s.loose_pairs = words(2 * pairs);
    s.long_lists = words(std::min(n, pairs / (LONG_LIST + 1) + 1));
    if (budget.sort == BoxSort::ManyGroups) {
        for (engine::BufferView* view : {&s.sort_keys, &s.other_keys, &s.other_order})
            *view = words(n);
        s.histogram = words(histogram);
        s.digit_offsets = words(histogram + 1);
    }
    if (const auto status = arena.status(); !status) return status.error();
    return s;
}

void recordBroadPhase(Recorder& record, const BroadPhase& phase) {
    struct Push {
        uint32_t box_capacity, pair_capacity;
    } push = {phase.budget.boxes, phase.budget.pairs};
    record.commands().beginLabel("broad_phase");
    record.runGroups("pair_few", 1, push, {record.counts(), record.args(), phase.box_low, phase.box_high, phase.pairs});
    if (needsTree(phase.budget)) {
        recordOrder(record, phase);
        recordTree(record, phase);
        recordSearch(record, phase);
        recordPairOrder(record, phase);
    }
    record.commands().endLabel();
}

} // namespace brittle
