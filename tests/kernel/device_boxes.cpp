#include "tests/kernel/device_boxes.h"

#include <bit>

namespace kernel_test {
namespace {

Word4 corner(const std::array<double, 3>& place, uint32_t w) {
    const auto bits = [&](size_t axis) { return std::bit_cast<uint32_t>(static_cast<float>(place[axis])); };
    return {bits(0), bits(1), bits(2), w};
}

void stopUnless(const engine::Result<void>& result) {
    if (result) return;
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::_Exit(EXIT_FAILURE);
}

} // namespace

DeviceBoxes upload(const Boxes& boxes, size_t room) {
    std::vector<Word4> low, high;
    for (const reference::SolidBox& box : boxes) {
        low.push_back(corner(box.low, box.body));
        high.push_back(corner(box.high, (box.fixed ? BOX_STATIC : 0u) | (box.absent ? BOX_ABSENT : 0u)));
    }
    return {bufferOf(low, room), bufferOf(high, room)};
}

FoundPairs pairsOnDevice(const Boxes& boxes, const BroadPhaseRun& run) {
    const auto count = static_cast<uint32_t>(boxes.size());
    brittle::BroadPhaseBudget budget = {run.box_capacity, run.pair_capacity, run.sort};
    if (budget.boxes == 0) budget.boxes = std::max(count, 1u);
    if (budget.pairs == 0) budget.pairs = static_cast<uint32_t>(reference::pairsThatMeet(boxes).size()) + 1;
    auto arena = engine::ScratchArena::create(engine_test::device(), std::max<uint64_t>(brittle::broadPhaseBytes(budget), 16));
    ENGINE_ASSERT(arena.has_value());
    const auto scratch = brittle::layOutBroadPhase(*arena, budget);
    stopUnless(scratch ? engine::Result<void>() : scratch.error());
    Counts counts;
    counts[COUNT_BOXES] = count;
    counts[STATUS_FAILED] = run.failed_before;
    const DeviceBoxes in = upload(boxes, 1);
    const engine::Buffer pairs = blankBuffer<Word2>(budget.pairs);
    onDevice([&](engine::Commands& commands) {
        brittle::Recorder record(commands, run.library != nullptr ? *run.library : kernels(), counts.words, counts.args);
        brittle::recordBroadPhase(record, {budget, *scratch, in.low, in.high, pairs});
        stopUnless(record.status());
    });
    return {valuesOf<Word2>(pairs, counts[COUNT_BOX_PAIRS]), counts[STATUS_FAILED], counts[STATUS_NEEDED + COUNT_BOX_PAIRS],
            counts[STATUS_NEEDED + COUNT_BOXES], counts.argsOf(COUNT_BOX_PAIRS)};
}

} // namespace kernel_test
