// Broad phase: which boxes of pieces meet. Recorded into the caller's command buffer; the host reads nothing.
//
// Up to FEW_BOXES are held each against each. More are put in order along Hilbert's curve through their centers, and a tree of
// four children a node stands over that order as it is (lib/box_tree.glsl): its levels are blocks of equal length, so it has
// neither links nor a depth to go beyond, and is made by two dispatches at most. Over the same leaves Karras' radix tree over
// Morton codes (Maximizing Parallelism in the Construction of BVHs, 2012) has its nodes visited a little more often.
// Every box that moves then asks for what it meets to its right, and what was found is counted, placed and put in order.
#pragma once

#include "engine/arena.h"
#include "modules/brittle/fracture/recorder.h"
#include "shaders-spirv/shared/broad_phase.h"

namespace brittle {

// How the order of the boxes is sorted. Both give the same.
enum class BoxSort : uint8_t {
    OneGroup,  // by a single workgroup, without a dispatch between two digits; up to kMostGroupSorted boxes
    ManyGroups // by the radix sort of shaders-spirv/primitives
};

constexpr uint32_t kMostBoxes = 1u << 18;       // that a lane can go through (MOST_TURNS)
constexpr uint32_t kMostGroupSorted = 1u << 17; // likewise

struct BroadPhaseBudget {
    uint32_t boxes = 0; // slots, the free ones included
    uint32_t pairs = 0;
    BoxSort sort = BoxSort::OneGroup;
};

// One workgroup for all on a device that has few at a time, and for few boxes.
constexpr BoxSort chosenSort(uint32_t boxes, bool on_cpu) {
    return boxes <= (on_cpu ? kMostGroupSorted : 8192u) ? BoxSort::OneGroup : BoxSort::ManyGroups;
}

// What it needs in between, and nobody else.
struct BroadPhaseScratch {
    engine::BufferView extent, key_low, key_high, order, nodes, pair_counts, pair_offsets, sums, found_pairs, loose_pairs,
        long_lists;
    engine::BufferView sort_keys, other_keys, other_order, histogram, digit_offsets; // of BoxSort::ManyGroups
};

// Errors: more than kMostBoxes, a sort that does not reach so far, no room in the arena.
engine::Result<BroadPhaseScratch> layOutBroadPhase(engine::ScratchArena& arena, const BroadPhaseBudget& budget);
// Bytes of an arena that holds it, at most.
uint64_t broadPhaseBytes(const BroadPhaseBudget& budget);

struct BroadPhase {
    BroadPhaseBudget budget;
    BroadPhaseScratch scratch;
    // In, 16 bytes a box: corners in meters, w of low the body (less than NO_BODY), w of high BOX_* flags. A box with a low
    // corner above its high one, or with what is no number, stands for no box.
    engine::BufferView box_low, box_high;
    // Out, 8 bytes a pair: piece a < piece b of different bodies, at least one of which moves, with boxes that meet (touching
    // counts), sorted by (a, b).
    engine::BufferView pairs;
};

// In: counts[COUNT_BOXES]. Out: `pairs`; counts[COUNT_BOX_PAIRS] and counts[COUNT_BOXES] with their dispatch arguments. More
// boxes or pairs than there is room for set STATUS_FAILED to FAILED_CAPACITY, the count to 0 and its STATUS_NEEDED to the
// number that would have been needed; a piece that meets more others than a lane can walk to (over 40,000) sets FAILED_PAIRING.
// With STATUS_FAILED set beforehand nothing is found. The recorder's counts are those of shared/broad_phase.h.
void recordBroadPhase(Recorder& record, const BroadPhase& phase);

} // namespace brittle
