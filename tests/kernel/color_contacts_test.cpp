// color_contacts: contacts of one color can be solved side by side, and none is lost on the way into the order of colors.
#include "tests/kernel/solver_lab.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace kernel_test {
namespace {

struct Colored {
    std::vector<uint32_t> colors, slots; // of each contact
    std::vector<uint32_t> start;         // of each color, NO_COLOR as the last, and the end
    std::vector<uint32_t> wide;          // counts that were published of the first colors
    std::vector<uint32_t> wide_groups;   // and workgroups
};

// As if all were of one large island, which begins with more contacts than a small one has.
Colored colorsOnDevice(const Touching& touching) {
    DeviceTouching in(touching);
    const uint32_t count = touching.count(), bodies = static_cast<uint32_t>(touching.moves.size());
    const engine::Buffer body_colors = bufferOf(std::vector<uint32_t>(4 * bodies)),
                         bids = bufferOf(std::vector<uint32_t>(bodies, NO_INDEX)),
                         waiting = blankBuffer<uint32_t>(2 * count + 2), slots = blankBuffer<uint32_t>(count),
                         start = blankBuffer<uint32_t>(COLOR_WORDS), islands = bufferOf(std::vector<uint32_t>(bodies)),
                         sizes = bufferOf(std::vector<uint32_t>(bodies, FEW_CONTACTS + 1)), ranges = blankBuffer<Word2>(bodies),
                         listed = blankBuffer<uint32_t>(count);
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("color_contacts"), 1, std::array<uint32_t, 2>{std::max(count, 1u), FEW_CONTACTS},
                                {in.counts.words, in.contact_pairs, in.memory, in.solver_bodies, body_colors, bids, waiting,
                                 slots, start, in.counts.args, islands, sizes, ranges, listed});
    });
    Colored out = {{}, valuesOf<uint32_t>(slots, count), valuesOf<uint32_t>(start, COLORS + 2), {}, {}};
    for (const uint32_t pair : in.pair_of)
        out.colors.push_back(in.memory.mappedAs<gpu::ContactMemory>()[pair].ids.w);
    for (uint32_t color = 0; color < WIDE_COLORS; ++color) {
        out.wide.push_back(in.counts[COUNT_FIRST_COLOR + color]);
        out.wide_groups.push_back(in.counts.argsOf(COUNT_FIRST_COLOR + color)[0]);
    }
    return out;
}

uint32_t classOf(uint32_t color) { return std::min<uint32_t>(color, NO_COLOR); }

// Whether two contacts of a color share a body that moves.
bool sharesABody(const Touching& touching, const std::vector<uint32_t>& colors) {
    std::set<Word2> seen;
    for (uint32_t c = 0; c < touching.count(); ++c)
        for (const uint32_t body : touching.bodies[c])
            if (colors[c] < COLORS && touching.moves[body] && !seen.insert({colors[c], body}).second) return true;
    return false;
}

// Contacts without a color are solved one after the other: in their own order, whatever lane places them.
bool colorlessAreInOrder(const std::vector<uint32_t>& colors, const std::vector<uint32_t>& slots) {
    uint32_t last = 0;
    for (size_t c = 0; c < colors.size(); ++c) {
        if (colors[c] < COLORS) continue;
        if (slots[c] < last) return false;
        last = slots[c];
    }
    return true;
}

// Every contact has a slot of its own, among those of its color.
void expectInOrder(const Touching& touching, const Colored& out) {
    std::vector<uint32_t> sizes(COLORS + 1), sorted = out.slots;
    for (const uint32_t color : out.colors)
        ++sizes[classOf(color)];
    EXPECT_EQ(out.start[0], 0u);
    for (uint32_t color = 0; color <= NO_COLOR; ++color)
        EXPECT_EQ(out.start[color + 1] - out.start[color], sizes[color]) << color;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, countUp(touching.count()));
    for (uint32_t c = 0; c < touching.count(); ++c) {
        EXPECT_GE(out.slots[c], out.start[classOf(out.colors[c])]) << c;
        EXPECT_LT(out.slots[c], out.start[classOf(out.colors[c]) + 1]) << c;
    }
    EXPECT_TRUE(colorlessAreInOrder(out.colors, out.slots));
}

// Those that hold a color of a body which another contact of it holds, too, have none.
std::vector<uint32_t> uncontested(const Touching& touching) {
    std::map<Word2, uint32_t> holders; // of a color of a body
    for (uint32_t c = 0; c < touching.count(); ++c)
        for (const uint32_t body : touching.bodies[c])
            if (touching.moves[body]) ++holders[{touching.colors[c], body}];
    std::vector<uint32_t> colors = touching.colors;
    for (uint32_t c = 0; c < touching.count(); ++c)
        for (const uint32_t body : touching.bodies[c])
            if (holders[{touching.colors[c], body}] > 1) colors[c] = NO_COLOR;
    return colors;
}

// One contact after the other, the best bid first: each takes the lowest color that its bodies have not.
std::vector<uint32_t> colorsOneByOne(const Touching& touching) {
    std::vector<std::set<uint32_t>> taken(touching.moves.size());
    std::vector<uint32_t> colors = touching.colors, waiting;
    const auto take = [&](uint32_t c) {
        for (const uint32_t body : touching.bodies[c])
            if (touching.moves[body]) taken[body].insert(colors[c]);
    };
    for (uint32_t c = 0; c < touching.count(); ++c)
        if (colors[c] < COLORS)
            take(c);
        else
            waiting.push_back(c);
    std::ranges::sort(waiting, {}, [](uint32_t c) { return (c * 0x9e3779b1u) & 0x7fffffffu; });
    for (const uint32_t c : waiting) {
        const auto& [a, b] = touching.bodies[c];
        for (colors[c] = 0; colors[c] < COLORS && (taken[a].contains(colors[c]) || taken[b].contains(colors[c]));)
            ++colors[c];
        if (colors[c] < COLORS) take(c);
    }
    return colors;
}

// A body in the middle that so many others touch.
Touching star(uint32_t contacts) {
    Touching star;
    star.moves.assign(contacts + 1, true);
    for (uint32_t k = 0; k < contacts; ++k)
        star.add(0, k + 1);
    return star;
}

TEST(SmallColorContacts, NoneAreNone) {
    const Colored out = colorsOnDevice({{true, true}, {}, {}});
    EXPECT_EQ(out.start, std::vector<uint32_t>(COLORS + 2, 0));
}

TEST(SmallColorContacts, OfOneColorShareNoBodyThatMoves) {
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u, 1234u, 20'000u}) {
        const Touching heap = randomHeap(count, count);
        const Colored out = colorsOnDevice(heap);
        EXPECT_FALSE(sharesABody(heap, out.colors)) << count;
        EXPECT_TRUE(std::ranges::all_of(out.colors, [](uint32_t color) { return color < COLORS; })) << count;
        expectInOrder(heap, out);
    }
}

// So they depend on the list and on no lane.
TEST(SmallColorContacts, AreThoseThatTakingTurnsByBidsGives) {
    for (const uint32_t count : {65u, 1234u}) {
        Touching heap = randomHeap(count, 7 * count);
        EXPECT_EQ(colorsOnDevice(heap).colors, colorsOneByOne(heap));
        std::ranges::shuffle(heap.bodies, Chance(count).engine());
        const Colored other = colorsOnDevice(heap);
        EXPECT_EQ(other.colors, colorsOneByOne(heap));
        EXPECT_FALSE(sharesABody(heap, other.colors));
        expectInOrder(heap, other);
    }
}

TEST(SmallColorContacts, KeepTheColorsThatTheyHad) {
    Touching heap = randomHeap(1000, 3);
    heap.colors = colorsOnDevice(heap).colors;
    Chance chance(5);
    for (uint32_t& color : heap.colors) {
        color = COLORS - 1 - color; // any colors do
        if (chance.oneIn(4)) color = chance.oneIn(2) ? NO_INDEX : uint32_t{NO_COLOR};
    }
    const Colored out = colorsOnDevice(heap);
    for (uint32_t c = 0; c < heap.count(); ++c)
        if (heap.colors[c] < COLORS) {
            EXPECT_EQ(out.colors[c], heap.colors[c]) << c;
        }
    EXPECT_EQ(out.colors, colorsOneByOne(heap));
    EXPECT_FALSE(sharesABody(heap, out.colors));
    expectInOrder(heap, out);
}

// As contacts do that were not solved for a step, or whose bodies slept.
TEST(SmallColorContacts, ThatComeBackToColorsGivenAwayTakeTurnsAnew) {
    for (const uint32_t kept : {1u, 3u, 12u}) {
        Touching heap = randomHeap(1234, kept);
        heap.colors = colorsOnDevice(heap).colors;
        Chance chance(kept);
        for (uint32_t& color : heap.colors)
            if (chance.oneIn(5)) color = chance.below(kept);
        ASSERT_TRUE(sharesABody(heap, heap.colors));
        Touching rest = heap;
        rest.colors = uncontested(heap);
        const Colored out = colorsOnDevice(heap);
        EXPECT_EQ(out.colors, colorsOneByOne(rest));
        EXPECT_FALSE(sharesABody(heap, out.colors));
        expectInOrder(heap, out);
    }
}

TEST(SmallColorContacts, WithTheGroundAloneHaveOneColor) {
    Touching floor;
    floor.moves.assign(301, true);
    floor.moves[0] = false;
    for (uint32_t k = 1; k <= 300; ++k)
        floor.add(0, k);
    const Colored out = colorsOnDevice(floor);
    EXPECT_EQ(out.colors, std::vector<uint32_t>(300, 0));
    expectInOrder(floor, out);
}

TEST(SmallColorContacts, BeyondTheLastColorGoBehindAllOthersAndAreNotLost) {
    for (const uint32_t count : {64u, 65u, 200u}) {
        const Touching crowd = star(count);
        const Colored out = colorsOnDevice(crowd);
        EXPECT_FALSE(sharesABody(crowd, out.colors));
        EXPECT_EQ(out.start[NO_COLOR], 64u);
        EXPECT_EQ(out.start[NO_COLOR + 1], count);
        expectInOrder(crowd, out);
    }
}

// More rounds than there are, or more turns than a lane has.
TEST(ColorContacts, ThatRunOutOfTurnsAreLeftWithoutAColor) {
    for (const uint32_t count : {3000u, 60'000u}) {
        const Touching crowd = star(count);
        const Colored out = colorsOnDevice(crowd);
        EXPECT_FALSE(sharesABody(crowd, out.colors));
        EXPECT_EQ(out.start[NO_COLOR + 1], count);
        EXPECT_GT(out.start[NO_COLOR], 8u);
        expectInOrder(crowd, out);
    }
}

// The host need not know how many there are of a color.
TEST(SmallColorContacts, OfTheFirstColorsArePublishedWhereThereAreMany) {
    const Colored few = colorsOnDevice(randomHeap(FEW_CONTACTS, 1));
    EXPECT_EQ(few.wide, std::vector<uint32_t>(WIDE_COLORS, 0));
    EXPECT_EQ(few.wide_groups, std::vector<uint32_t>(WIDE_COLORS, 0));
    const Colored many = colorsOnDevice(randomHeap(FEW_CONTACTS + 1, 1));
    for (uint32_t color = 0; color < WIDE_COLORS; ++color) {
        const uint32_t size = many.start[color + 1] - many.start[color];
        EXPECT_EQ(many.wide[color], size);
        EXPECT_EQ(many.wide_groups[color], (size + GROUP_SIZE - 1) / GROUP_SIZE);
    }
    EXPECT_GT(many.wide[0], 0u);
}

// Heaps that share no body, each an island named by its first body.
struct Heaps {
    Touching all;
    std::vector<uint32_t> islands;  // of each body
    std::vector<uint32_t> contacts; // of each heap
};

Heaps heapsOf(const std::vector<uint32_t>& sizes) {
    Heaps heaps;
    for (const uint32_t size : sizes) {
        const Touching heap = randomHeap(size, size);
        const auto first = static_cast<uint32_t>(heaps.all.moves.size());
        heaps.all.moves.insert(heaps.all.moves.end(), heap.moves.begin(), heap.moves.end());
        heaps.islands.resize(heaps.all.moves.size(), first);
        for (const Word2& pair : heap.bodies)
            heaps.all.add(first + pair[0], first + pair[1]);
        heaps.contacts.push_back(size);
    }
    std::ranges::shuffle(heaps.all.bodies, Chance(9).engine());
    return heaps;
}

struct ByIsland {
    std::vector<uint32_t> colors, slots, start, ends;
    std::vector<Word2> ranges; // of small islands
};

ByIsland islandsOnDevice(const Heaps& heaps) {
    DeviceTouching in(heaps.all);
    const uint32_t count = heaps.all.count(), bodies = static_cast<uint32_t>(heaps.all.moves.size());
    const engine::Buffer body_colors = bufferOf(std::vector<uint32_t>(4 * bodies)),
                         bids = bufferOf(std::vector<uint32_t>(bodies, NO_INDEX)),
                         waiting = blankBuffer<uint32_t>(2 * count + 2), slots = blankBuffer<uint32_t>(count),
                         start = blankBuffer<uint32_t>(COLOR_WORDS), islands = bufferOf(heaps.islands),
                         sizes = bufferOf(std::vector<uint32_t>(bodies)), ranges = blankBuffer<Word2>(bodies),
                         listed = blankBuffer<uint32_t>(count), ends = bufferOf(std::vector<uint32_t>(count));
    onDevice([&](engine::Commands& commands) {
        commands.dispatchGroups(kernel("color_contacts"), 1, std::array<uint32_t, 2>{count, FEW_CONTACTS},
                                {in.counts.words, in.contact_pairs, in.memory, in.solver_bodies, body_colors, bids, waiting,
                                 slots, start, in.counts.args, islands, sizes, ranges, listed});
        commands.dispatchIndirect(kernel("order_islands"),
                                  engine::BufferView(in.counts.args).sub(36 * COUNT_SOLVED_APART + 24, 12), engine::NoPush{},
                                  {start, in.contact_pairs, in.memory, ranges, listed, slots, ends});
    });
    ByIsland out = {
        {}, valuesOf<uint32_t>(slots, count), valuesOf<uint32_t>(start, COLOR_WORDS), valuesOf<uint32_t>(ends, count), {}};
    out.ranges = valuesOf<Word2>(ranges, out.start[ISLANDS_APART]);
    EXPECT_EQ(in.counts[COUNT_BY_COLOR], out.start[NO_COLOR + 1] != 0 ? 1u : 0u);
    EXPECT_EQ(in.counts[COUNT_SOLVED_APART], out.ranges.size() + in.counts[COUNT_BY_COLOR]);
    for (const uint32_t pair : in.pair_of)
        out.colors.push_back(in.memory.mappedAs<gpu::ContactMemory>()[pair].ids.w);
    return out;
}

// Follows the ends of colors through a range as a workgroup does: what it meets, color by color.
std::vector<std::vector<uint32_t>> walk(const ByIsland& out, const Word2& range) {
    std::vector<uint32_t> contact_at(out.slots.size());
    for (uint32_t c = 0; c < out.slots.size(); ++c)
        contact_at[out.slots[c]] = c;
    std::vector<std::vector<uint32_t>> met;
    for (uint32_t begin = range[0]; begin < range[1] && out.ends[begin] > begin; begin = out.ends[begin])
        met.emplace_back(contact_at.begin() + begin, contact_at.begin() + out.ends[begin]);
    return met;
}

TEST(SmallColorContacts, OfSmallIslandsStandApartColorByColor) {
    const Heaps heaps = heapsOf({5, FEW_CONTACTS + 1, 40, FEW_CONTACTS, 1, 1700, 333});
    const ByIsland out = islandsOnDevice(heaps);
    EXPECT_EQ(out.colors, colorsOnDevice(heaps.all).colors);
    std::vector<uint32_t> sorted = out.slots;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, countUp(heaps.all.count()));
    EXPECT_EQ(out.start[NO_COLOR + 1], FEW_CONTACTS + 1 + 1700u);
    EXPECT_EQ(out.start[COLORS_USED], 1 + *std::ranges::max_element(out.colors));
    ASSERT_EQ(out.ranges.size(), 5u);
    for (const Word2& range : out.ranges) {
        uint32_t met = 0, last = 0;
        std::set<uint32_t> islands;
        for (const auto& color : walk(out, range)) {
            met += static_cast<uint32_t>(color.size());
            for (const uint32_t c : color) {
                EXPECT_EQ(out.colors[c], out.colors[color.front()]);
                islands.insert(heaps.islands[heaps.all.bodies[c][0]]);
            }
            EXPECT_GE(out.colors[color.front()], last);
            last = out.colors[color.front()] + 1;
        }
        EXPECT_EQ(met, range[1] - range[0]);
        EXPECT_EQ(islands.size(), 1u);
    }
}

TEST(SmallColorContacts, WithoutAColorAreWalkedOneByOneInTheirIsland) {
    Heaps crowd = {star(200), std::vector<uint32_t>(201, 0), {200}};
    const ByIsland out = islandsOnDevice(crowd);
    ASSERT_EQ(out.ranges.size(), 1u);
    const auto met = walk(out, out.ranges[0]);
    EXPECT_EQ(met.size(), 200u); // all share a body
    EXPECT_TRUE(colorlessAreInOrder(out.colors, out.slots));
    EXPECT_EQ(out.start[COLORS_LACKED], 136u);
    EXPECT_EQ(out.start[NO_COLOR + 1], 0u);
}

} // namespace
} // namespace kernel_test
