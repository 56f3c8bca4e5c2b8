// list_whole, list_fans, list_caps, unite_triangles, flag_components, key_triangles, the sort and bound_components: pieces
// against a union-find on the host, on triangles drawn at random and in whole events.
#include "tests/kernel/device_event.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <random>

namespace kernel_test {
namespace {

using brittle::FractureOptions;

struct Islands {
    std::vector<uint32_t> component; // of every triangle, by lowest triangles; NO_INDEX for those that are dropped
    std::vector<uint32_t> order;     // triangles that stay, by component, then by number
    std::vector<uint32_t> start;     // of every component in the order, and the end
};

// Triangles of one cell that share a side belong together.
std::vector<uint32_t> lowestTogether(const std::vector<Word4>& pieces) {
    std::vector<uint32_t> parent(pieces.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t t) {
        while (parent[t] != t)
            t = parent[t] = parent[parent[t]];
        return t;
    };
    std::map<std::array<uint32_t, 3>, uint32_t> sides;
    for (uint32_t t = 0; t < pieces.size(); ++t)
        for (size_t k = 0; k < 3 && pieces[t][3] != NO_INDEX; ++k) {
            const uint32_t a = pieces[t][k], b = pieces[t][(k + 1) % 3];
            const uint32_t other = root(sides.try_emplace({std::min(a, b), std::max(a, b), pieces[t][3]}, t).first->second);
            const uint32_t mine = root(t);
            parent[std::max(mine, other)] = std::min(mine, other);
        }
    for (uint32_t t = 0; t < pieces.size(); ++t)
        parent[t] = root(t);
    return parent;
}

Islands islandsOf(const std::vector<Word4>& pieces) {
    const std::vector<uint32_t> lowest = lowestTogether(pieces);
    Islands islands;
    std::vector<std::vector<uint32_t>> members;
    for (uint32_t t = 0; t < pieces.size(); ++t) {
        const bool stays = pieces[t][3] != NO_INDEX;
        if (stays && lowest[t] == t) members.emplace_back();
        islands.component.push_back(!stays ? NO_INDEX
                                           : (lowest[t] == t ? uint32_t(members.size()) - 1 : islands.component[lowest[t]]));
        if (stays) members[islands.component[t]].push_back(t);
    }
    for (const std::vector<uint32_t>& member : members) {
        islands.start.push_back(static_cast<uint32_t>(islands.order.size()));
        islands.order.insert(islands.order.end(), member.begin(), member.end());
    }
    islands.start.push_back(static_cast<uint32_t>(islands.order.size()));
    return islands;
}

// Up to the keys: the sort has its own test.
void expectUnited(const std::vector<Word4>& pieces) {
    const uint32_t n = static_cast<uint32_t>(pieces.size()), table_size = std::bit_ceil(6 * n);
    Counts counts;
    counts[COUNT_TRIANGLES] = n;
    std::vector<uint32_t> self(n);
    std::iota(self.begin(), self.end(), 0u);
    const engine::Buffer in = bufferOf(pieces), parents = bufferOf(self), table = bufferOf(std::vector<uint32_t>(table_size));
    const engine::Buffer flags = blankBuffer<Word4>(n), sums = blankBuffer<Word4>(n / SCAN_BLOCK + 1);
    const engine::Buffer offsets = blankBuffer<Word4>(n + 1), keys = blankBuffer<uint32_t>(n),
                         values = blankBuffer<uint32_t>(n);
    const engine::Buffer components = blankBuffer<uint32_t>(n);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("unite_triangles"), n, table_size - 1, {counts.words, in, parents, table});
        commands.dispatch(kernel("flag_components"), n, engine::NoPush{}, {counts.words, in, parents, flags});
        scan(commands, counts, n, flags, sums, offsets, true, {COUNT_VALID, COUNT_COMPONENTS, NO_INDEX, NO_INDEX});
        commands.dispatch(kernel("key_triangles"), n, engine::NoPush{},
                          {counts.words, offsets, parents, keys, values, components});
    });
    const Islands islands = islandsOf(pieces);
    ASSERT_EQ(counts[STATUS_BAD_UNION], 0u);
    ASSERT_EQ(counts[COUNT_VALID], islands.order.size());
    ASSERT_EQ(counts[COUNT_COMPONENTS] + 1, islands.start.size());
    ASSERT_EQ(valuesOf<uint32_t>(components, n), islands.component);
    uint32_t at = 0;
    for (uint32_t t = 0; t < n; ++t) {
        if (islands.component[t] == NO_INDEX) continue;
        ASSERT_EQ(values.mappedAs<uint32_t>()[at], t);
        ASSERT_EQ(keys.mappedAs<uint32_t>()[at++], islands.component[t]);
    }
}

// Three corners of a few, in a few cells, some dropped: from nearly nothing in common to nearly all.
std::vector<Word4> randomPieces(uint32_t count, uint32_t corners, uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
    std::vector<Word4> pieces;
    for (uint32_t t = 0; t < count; ++t) {
        const uint32_t a = below(corners), b = (a + 1 + below(corners - 1)) % corners;
        uint32_t c = below(corners);
        while (c == a || c == b)
            c = below(corners);
        pieces.push_back({a, b, c, below(10) == 0 ? NO_INDEX : below(3)});
    }
    return pieces;
}

TEST(SmallIslands, OfRandomTriangles) {
    for (const uint32_t count : kSizes)
        for (const uint32_t corners : {4u, 20u, 60u, 400u})
            expectUnited(randomPieces(count, corners, count + corners));
}

// Strips whose triangles come in no order, so that long chains of links form.
TEST(Islands, OfLongStrips) {
    std::vector<Word4> pieces;
    for (uint32_t t = 0; t < 40'000; ++t)
        pieces.push_back({t, t + 1, t + 2, t / 9000});
    expectUnited(pieces);
    std::reverse(pieces.begin(), pieces.end());
    expectUnited(pieces);
    std::shuffle(pieces.begin(), pieces.end(), std::mt19937(2));
    expectUnited(pieces);
}

// The same corners in two cells, and a corner in common, join nothing.
TEST(SmallIslands, AreNotJoinedAcrossCellsOrByACorner) {
    const std::vector<Word4> pieces = {{0, 1, 2, 0}, {2, 1, 0, 1}, {2, 3, 4, 0}, {4, 5, 6, NO_INDEX}, {1, 0, 7, 0}};
    EXPECT_EQ(islandsOf(pieces).component, (std::vector<uint32_t>{0, 1, 2, NO_INDEX, 0}));
    expectUnited(pieces);
}

struct Pieces {
    const DeviceEvent& event;
    std::vector<Word4> pieces = event.read<Word4>(event.buffers().pieces, event[COUNT_TRIANGLES]);
    std::vector<uint32_t> sources = event.read<uint32_t>(event.buffers().sources, event[COUNT_TRIANGLES]);
};

void expectSplit(const Pieces& p) {
    const Islands islands = islandsOf(p.pieces);
    const uint32_t valid = p.event[COUNT_VALID], components = p.event[COUNT_COMPONENTS];
    ASSERT_EQ(components + 1, islands.start.size());
    EXPECT_EQ(p.event.read<uint32_t>(p.event.buffers().values, valid), islands.order);
    EXPECT_EQ(p.event.read<uint32_t>(p.event.buffers().component_start, components + 1), islands.start);
    EXPECT_EQ(p.event.read<uint32_t>(p.event.buffers().components, p.pieces.size()), islands.component);
}

// Every side of a component's triangles is walked as often one way as the other.
void expectClosed(const Pieces& p) {
    const std::vector<uint32_t> component = islandsOf(p.pieces).component;
    std::map<std::array<uint32_t, 3>, int> sides;
    for (size_t t = 0; t < p.pieces.size(); ++t)
        for (size_t k = 0; k < 3 && component[t] != NO_INDEX; ++k) {
            const uint32_t a = p.pieces[t][k], b = p.pieces[t][(k + 1) % 3];
            sides[{std::min(a, b), std::max(a, b), component[t]}] += a < b ? 1 : -1;
        }
    for (const auto& [side, net] : sides)
        ASSERT_EQ(net, 0) << "side " << side[0] << " " << side[1] << " of component " << side[2];
}

// Whole triangles are the mesh's own, in their places; caps come in pairs that are mirror images.
void expectListed(const Pieces& p) {
    const uint32_t mesh = p.event.triangleCount(), caps = mesh + p.event[COUNT_FAN_TRIANGLES];
    ASSERT_EQ(p.pieces.size(), caps + 2 * p.event[COUNT_CAP_TRIANGLES]);
    for (uint32_t t = 0; t < p.pieces.size(); ++t) {
        ASSERT_EQ((p.sources[t] & INNER_BIT) != 0, t >= caps);
        if (t < mesh) {
            ASSERT_EQ(p.sources[t], t);
        }
        if (t < caps) {
            ASSERT_LT(p.sources[t], mesh);
        }
        if (t < caps || (t - caps) % 2 == 1) continue;
        const Word4 &a = p.pieces[t], &b = p.pieces[t + 1];
        ASSERT_EQ((Word4{a[0], a[2], a[1], 0}), (Word4{b[0], b[1], b[2], 0}));
        ASSERT_NE(a[3], a[3] == NO_INDEX ? 0 : b[3]);
    }
}

void expectIslands(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Islands);
    const Pieces pieces{event};
    expectListed(pieces);
    expectSplit(pieces);
    expectClosed(pieces);
}

TEST(SmallIslands, OfAnEventAreClosed) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectIslands(bumpy, {count, count, {}});
}

TEST(Islands, OfManyCellsAreClosed) { expectIslands(solidOf("bumpy:2"), {1234, 5, {}}); }

// The faces of the cube lie in bisectors; what the diagram gives to a site outside belongs to the site behind the face.
TEST(SmallIslands, OfFacesInBisectorsAreClosed) {
    FractureOptions options = latticeSites(.5);
    for (uint32_t seed = 0; seed < 4; ++seed) {
        std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(seed));
        expectIslands(solidOf("cube"), options);
        EXPECT_EQ(DeviceEvent(solidOf("cube"), options, Until::Islands)[COUNT_COMPONENTS], 8u);
    }
}

// The middle cell holds two stretches of the ring, which do not touch.
TEST(Islands, OfOneCellAreSeveralPieces) {
    const FractureOptions options{0, 0, {{0, 0, 0}, {.9, .1, 0}, {-.9, -.1, 0}, {0, 0, 5}}};
    expectIslands(solidOf("ring"), options);
    EXPECT_GT(DeviceEvent(solidOf("ring"), options, Until::Islands)[COUNT_COMPONENTS], 3u);
}

} // namespace
} // namespace kernel_test
