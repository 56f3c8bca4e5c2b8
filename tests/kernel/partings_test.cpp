// bound_partings: the range of partings that a fragment looks through, against a count of the pairs of its cell one by one.
#include "tests/kernel/lab.h"

#include <algorithm>
#include <random>

namespace kernel_test {
namespace {

// Fragments of cells with one to four islands each. Each pair of islands of a cell is a parting or not.
struct Islands {
    std::vector<uint32_t> cells, fragments;     // by place in the sorted list
    std::vector<std::array<uint32_t, 2>> pairs; // place of its first island; 1 for a parting

    explicit Islands(uint32_t cell_count) {
        std::mt19937 random(7);
        for (uint32_t cell = 0; cell < cell_count; ++cell)
            cells.insert(cells.end(), 1 + random() % 4, 3 * cell + 2);
        fragments = countUp(cells.size());
        std::ranges::shuffle(fragments, random);
        for (uint32_t a = 0; a < cells.size(); ++a)
            for (uint32_t b = a + 1; b < cells.size() && cells[b] == cells[a]; ++b)
                pairs.push_back({a, static_cast<uint32_t>(random() % 2)});
    }
    std::vector<uint32_t> offsets() const { // pairs before each place
        std::vector<uint32_t> before;
        for (uint32_t k = 0; k <= cells.size(); ++k)
            before.push_back(static_cast<uint32_t>(std::ranges::count_if(pairs, [&](const auto& p) { return p[0] < k; })));
        return before;
    }
    std::vector<uint32_t> slots() const { // partings before each pair
        std::vector<uint32_t> before = {0};
        for (const auto& pair : pairs)
            before.push_back(before.back() + pair[1]);
        return before;
    }
    Word2 expectedRange(uint32_t place) const {
        uint32_t first = 0, count = 0, in_cell = 0;
        for (const auto& pair : pairs) {
            const bool same = cells[pair[0]] == cells[place];
            in_cell += same ? 1 : 0;
            count += same ? pair[1] : 0;
            first += cells[pair[0]] < cells[place] ? pair[1] : 0;
        }
        return in_cell == 0 ? Word2{NO_INDEX, 0} : Word2{first, count};
    }
};

TEST(SmallPartings, OfAFragmentAreThoseOfItsCell) {
    for (const uint32_t cell_count : {1u, 2u, 40u}) {
        const Islands islands(cell_count);
        const auto n = static_cast<uint32_t>(islands.cells.size());
        Counts counts;
        counts[COUNT_FRAGMENTS] = n;
        counts[COUNT_ISLAND_PAIRS] = static_cast<uint32_t>(islands.pairs.size());
        const auto cells = bufferOf(islands.cells), fragments = bufferOf(islands.fragments),
                   offsets = bufferOf(islands.offsets()), slots = bufferOf(islands.slots()), ranges = blankBuffer<Word2>(n + 1);
        onDevice([&](engine::Commands& commands) {
            commands.dispatch(kernel("bound_partings"), n, engine::NoPush{},
                              {counts.words, cells, fragments, offsets, slots, ranges});
        });
        const auto found = valuesOf<Word2>(ranges, n + 1);
        for (uint32_t k = 0; k < n; ++k)
            EXPECT_EQ(found[islands.fragments[k]], islands.expectedRange(k)) << "place " << k << " of " << n;
        EXPECT_EQ(found[n][0], 0xcdcdcdcdu) << "nothing behind them is written";
    }
}

} // namespace
} // namespace kernel_test
