// count_adjacency, place_adjacency and order_adjacency: the contacts of each body, by which impulses are added up.
#include "tests/kernel/solver_lab.h"

#include <algorithm>

namespace kernel_test {
namespace {

struct Adjacency {
    std::vector<uint32_t> start, entries;
    uint32_t failed = 0;
};

// `slots` says where each contact is solved.
Adjacency adjacencyOnDevice(const Touching& touching, const std::vector<uint32_t>& slots) {
    DeviceTouching in(touching);
    const uint32_t count = touching.count(), bodies = static_cast<uint32_t>(touching.moves.size());
    const engine::Buffer counted = bufferOf(std::vector<uint32_t>(bodies)), cursors = bufferOf(std::vector<uint32_t>(bodies)),
                         sums = blankBuffer<uint32_t>(bodies / SCAN_BLOCK + 1), start = blankBuffer<uint32_t>(bodies + 1),
                         loose = blankBuffer<uint32_t>(2 * count + 1), entries = blankBuffer<uint32_t>(2 * count + 1),
                         contact_slots = bufferOf(slots);
    onDevice([&](engine::Commands& commands) {
        const auto& words = in.counts.words;
        commands.dispatch(kernel("count_adjacency"), count, engine::NoPush{},
                          {words, in.contact_pairs, in.memory, in.solver_bodies, counted});
        scan(commands, in.counts, bodies, counted, sums, start, false, {NO_INDEX, NO_INDEX, NO_INDEX, NO_INDEX});
        commands.dispatch(kernel("place_adjacency"), count, engine::NoPush{},
                          {words, in.contact_pairs, in.memory, in.solver_bodies, start, cursors, loose});
        commands.dispatch(kernel("order_adjacency"), count, engine::NoPush{},
                          {words, in.contact_pairs, in.memory, in.solver_bodies, start, loose, contact_slots, entries});
    });
    return {valuesOf<uint32_t>(start, bodies + 1), valuesOf<uint32_t>(entries, 2 * count), in.counts[STATUS_FAILED]};
}

std::vector<uint32_t> listOf(const Adjacency& adjacency, uint32_t body) {
    return {adjacency.entries.begin() + adjacency.start[body], adjacency.entries.begin() + adjacency.start[body + 1]};
}

// In the order of the list of contacts: what they are solved in may be any order.
std::vector<uint32_t> expectedList(const Touching& touching, const std::vector<uint32_t>& slots, uint32_t body) {
    std::vector<uint32_t> list;
    for (uint32_t c = 0; c < touching.count(); ++c)
        for (uint32_t side = 0; side < 2; ++side)
            if (touching.bodies[c][side] == body && touching.moves[body]) list.push_back(2 * slots[c] + side);
    return list;
}

std::vector<uint32_t> shuffledSlots(uint32_t count) {
    std::vector<uint32_t> slots = countUp(count);
    std::ranges::shuffle(slots, Chance(count).engine());
    return slots;
}

TEST(SmallAdjacency, ListsEveryContactOfABodyThatMovesInOrder) {
    for (const uint32_t count : {1u, 63u, 64u, 65u, 1234u}) {
        const Touching heap = randomHeap(count, count);
        const std::vector<uint32_t> slots = shuffledSlots(count);
        const Adjacency found = adjacencyOnDevice(heap, slots);
        for (uint32_t body = 0; body < heap.moves.size(); ++body)
            EXPECT_EQ(listOf(found, body), expectedList(heap, slots, body)) << body << " of " << count;
        EXPECT_EQ(found.failed, 0u);
    }
}

TEST(SmallAdjacency, OfNoContactsIsEmpty) {
    const Adjacency found = adjacencyOnDevice({std::vector<bool>(70, true), {}, {}}, {});
    EXPECT_EQ(found.start, std::vector<uint32_t>(71, 0));
}

// Sums over it round the same, whatever the colors that contacts got.
TEST(SmallAdjacency, KeepsItsOrderWhateverTheSlots) {
    const Touching heap = randomHeap(500, 9);
    const std::vector<uint32_t> slots = shuffledSlots(500);
    const Adjacency one = adjacencyOnDevice(heap, slots), other = adjacencyOnDevice(heap, countUp(500));
    ASSERT_EQ(one.start, other.start);
    for (uint32_t k = 0; k < one.start.back(); ++k)
        EXPECT_EQ(one.entries[k], 2 * slots[other.entries[k] / 2] + other.entries[k] % 2);
}

TEST(Adjacency, OfACrowdedBodyIsInOrderUpToALimitThatIsTold) {
    for (const uint32_t count : {5000u, MOST_IN_A_BIN + 1}) {
        Touching crowd;
        crowd.moves.assign(count + 1, false);
        crowd.moves[0] = true;
        for (uint32_t k = 0; k < count; ++k)
            crowd.add(0, k + 1);
        const std::vector<uint32_t> slots = shuffledSlots(count);
        const Adjacency found = adjacencyOnDevice(crowd, slots);
        EXPECT_EQ(found.failed != 0, count > MOST_IN_A_BIN) << count;
        if (found.failed == 0) {
            EXPECT_EQ(listOf(found, 0), expectedList(crowd, slots, 0));
        }
    }
}

} // namespace
} // namespace kernel_test
