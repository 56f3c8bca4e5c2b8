// cap_intervals on Voronoi edges made by hand: where the edge is inside the solid, from the depths of its ends and the points
// at which it passes the surface.
#include "tests/kernel/lab.h"

#include <algorithm>
#include <map>

namespace kernel_test {
namespace {

constexpr uint32_t kNone = NO_INDEX;

struct Passage {
    bool enters;
    uint32_t place; // equal ones lie at one place
};
using Interval = Word2; // from, to: passages in their order, then kStart and kEnd
constexpr uint32_t kStart = 1000, kEnd = 1001;

struct Edge {
    std::vector<Passage> passages;
    uint32_t depth_at_start = 0, depth_at_end = 0; // kNone: the edge comes from, or goes to, the wall of the box
    std::vector<Interval> inside;
};

// All edges are those of cells 0, 1 and 2, and so bound the same three faces.
struct EdgeBuffers {
    std::vector<Word4> sites;
    std::vector<Word2> ends, links, ordered;
    std::vector<uint32_t> offsets = {0};
    std::vector<int32_t> signs;
};

EdgeBuffers buffersOf(const std::vector<Edge>& edges) {
    EdgeBuffers b;
    for (const Edge& edge : edges) {
        b.sites.push_back({0, 1, 2, 0});
        b.ends.push_back({kNone, kNone});
        for (const size_t end : {size_t{0}, size_t{1}}) {
            const uint32_t depth = end == 0 ? edge.depth_at_start : edge.depth_at_end;
            if (depth == kNone) continue;
            b.ends.back()[end] = static_cast<uint32_t>(b.links.size());
            b.links.push_back({kNone, depth});
        }
        for (const Passage& passage : edge.passages) {
            b.ordered.push_back({static_cast<uint32_t>(b.signs.size()), passage.place});
            b.signs.push_back(passage.enters ? -1 : 1);
        }
        b.offsets.push_back(static_cast<uint32_t>(b.signs.size()));
    }
    return b;
}

struct Found {
    std::vector<std::vector<Interval>> inside; // of every edge
    uint32_t bad = 0;
};

// A segment of face f of an interval has the source 3 interval + f; the middle face sees the edge the other way round.
std::vector<Interval> intervalsOf(const std::vector<Word4>& segments) {
    std::map<uint32_t, std::vector<Interval>> sides;
    for (const Word4& s : segments)
        sides[s[2] / 3].push_back(s[2] % 3 == 1 ? Interval{s[1], s[0]} : Interval{s[0], s[1]});
    std::vector<Interval> intervals;
    for (const auto& [interval, ways] : sides) {
        EXPECT_EQ(interval, intervals.size());
        EXPECT_EQ(ways, std::vector<Interval>(3, ways[0]));
        intervals.push_back(ways[0]);
    }
    return intervals;
}

Found findOnDevice(const std::vector<Edge>& edges) {
    constexpr uint32_t kVertices = 10, kRoom = 4096;
    const EdgeBuffers b = buffersOf(edges);
    const uint32_t n = static_cast<uint32_t>(edges.size()), triples = static_cast<uint32_t>(b.signs.size());
    Counts counts;
    counts[COUNT_MESH_VERTICES] = kVertices;
    counts[COUNT_VORONOI_EDGES] = n;
    counts[COUNT_TRIPLES] = triples;
    const engine::Buffer cells = bufferOf<Word4>({{0, 0, 0, 0}, {2, 0, 0, 0}, {4, 0, 0, 0}, {6, 0, 0, 0}});
    const engine::Buffer neighbors = bufferOf<uint32_t>({1, 2, 0, 2, 0, 1}), sites = bufferOf(b.sites), ends = bufferOf(b.ends);
    const engine::Buffer links = bufferOf(b.links), triple_offsets = bufferOf(b.offsets), ordered = bufferOf(b.ordered);
    const engine::Buffer signs = bufferOf(b.signs), made = blankBuffer<uint32_t>(n), offsets = blankBuffer<uint32_t>(n + 1);
    const engine::Buffer face_counts = bufferOf(std::vector<uint32_t>(6)), cursors = bufferOf(std::vector<uint32_t>(6));
    const engine::Buffer sums = blankBuffer<uint32_t>(n / SCAN_BLOCK + 1), face_offsets = blankBuffer<uint32_t>(7);
    const engine::Buffer segments = blankBuffer<Word4>(kRoom);
    onDevice([&](engine::Commands& commands) {
        for (const uint32_t fill : {0u, 1u}) {
            commands.dispatch(kernel("cap_intervals", {fill}), n, engine::NoPush{},
                              {counts.words, cells, neighbors, sites, ends, links, triple_offsets, ordered, signs, made,
                               offsets, fill == 0 ? face_counts : cursors, face_offsets, segments});
            if (fill == 1) break;
            scan(commands, counts, n, made, sums, offsets, false, {COUNT_INTERVALS, kNone, kNone, kNone});
            scan(commands, counts, 6, face_counts, sums, face_offsets, false, {COUNT_SEGMENTS, kNone, kNone, kNone});
        }
    });
    Found found{{}, counts[STATUS_BAD_DEPTH]};
    if (found.bad != 0) return found;
    const auto all = intervalsOf(valuesOf<Word4>(segments, counts[COUNT_SEGMENTS]));
    EXPECT_EQ(all.size(), counts[COUNT_INTERVALS]);
    const std::vector<uint32_t> first = valuesOf<uint32_t>(offsets, n + 1);
    for (size_t e = 0; e < n; ++e) {
        found.inside.emplace_back(all.begin() + first[e], all.begin() + first[e + 1]);
        for (Interval& interval : found.inside.back())
            for (uint32_t& point : interval)
                point = point < kVertices + triples ? point - kVertices - b.offsets[e]
                                                    : (point - kVertices - triples == b.ends[e][0] ? kStart : kEnd);
    }
    return found;
}

const Passage kIn = {true, 0}, kOut = {false, 0};
Passage at(Passage passage, uint32_t place) { return {passage.enters, place}; }

const std::vector<Edge> kEdges = {
    {{}, 0, 0, {}},
    {{}, kNone, kNone, {}},
    {{}, 1, 1, {{kStart, kEnd}}},
    {{at(kIn, 0), at(kOut, 1)}, 0, 0, {{0, 1}}},
    {{at(kIn, 0), at(kOut, 1)}, kNone, kNone, {{0, 1}}},
    {{at(kOut, 0)}, 1, kNone, {{kStart, 0}}},
    {{at(kIn, 0)}, kNone, 1, {{0, kEnd}}},
    {{at(kOut, 0), at(kIn, 1)}, 1, 1, {{kStart, 0}, {1, kEnd}}},
    {{at(kIn, 0), at(kOut, 1), at(kIn, 2), at(kOut, 3)}, 0, 0, {{0, 1}, {2, 3}}},
    // Two solids that touch, whichever of the two passages comes first in the list: out of the one, then into the other.
    {{at(kIn, 0), at(kOut, 1), at(kIn, 1), at(kOut, 3)}, 0, 0, {{0, 1}, {2, 3}}},
    {{at(kIn, 0), at(kIn, 1), at(kOut, 1), at(kOut, 3)}, 0, 0, {{0, 2}, {1, 3}}},
    // Two hollows that touch.
    {{at(kOut, 0), at(kOut, 1), at(kIn, 1), at(kIn, 3)}, 1, 1, {{kStart, 0}, {2, 1}, {3, kEnd}}},
    // A surface that is only touched.
    {{at(kOut, 0), at(kIn, 0)}, 0, 0, {{1, 0}}},
    // Out before in, of a solid that is inside out: the way inside is walked backwards.
    {{at(kOut, 0), at(kIn, 1)}, 0, 0, {{1, 0}}},
    {{at(kOut, 0), at(kOut, 1), at(kIn, 2), at(kIn, 3)}, 0, 0, {{2, 1}, {3, 0}}},
    // Solids that overlap: the edge is inside twice.
    {{at(kIn, 0), at(kIn, 1), at(kOut, 2), at(kOut, 3)}, 0, 0, {{1, 2}, {0, 3}}}};

TEST(SmallIntervals, OfVoronoiEdgesAreWhereTheyAreInside) {
    const Found found = findOnDevice(kEdges);
    ASSERT_EQ(found.bad, 0u);
    for (size_t e = 0; e < kEdges.size(); ++e)
        EXPECT_EQ(found.inside[e], kEdges[e].inside) << "edge " << e;
}

TEST(SmallIntervals, OfAsManyEdgesAsThereAre) {
    for (const uint32_t count : {63u, 64u, 65u, 300u}) {
        std::vector<Edge> edges;
        for (uint32_t e = 0; e < count; ++e)
            edges.push_back(kEdges[e * 5 % kEdges.size()]);
        const Found found = findOnDevice(edges);
        ASSERT_EQ(found.bad, 0u);
        for (size_t e = 0; e < count; ++e)
            EXPECT_EQ(found.inside[e], edges[e].inside) << "edge " << e;
    }
}

// Depths that do not agree with the passages between them.
TEST(SmallIntervals, ThatDoNotAddUpAreCounted) {
    for (const Edge& edge : {Edge{{}, 0, 1, {}}, Edge{{at(kIn, 0)}, 0, 0, {}}, Edge{{at(kOut, 0)}, kNone, 0, {}}})
        EXPECT_EQ(findOnDevice({kEdges[3], edge}).bad, 1u);
}

} // namespace
} // namespace kernel_test
