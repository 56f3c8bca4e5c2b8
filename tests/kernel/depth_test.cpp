// assign_triples, group_triples, order_triples, start_depth and jump_depth: whether a Voronoi vertex is inside the solid must
// be what the solid angles of all triangles say, and points on a Voronoi edge must come in their order along it.
#include "tests/kernel/clipped_polygons.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using reference::GridPoint;
using Row = std::array<long double, 3>;

Row minus(const GridPoint& a, const GridPoint& b) {
    return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
            static_cast<long double>(a[2]) - b[2]};
}
Row cross(const Row& a, const Row& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// d_k . w = |d_k|^2 / 2 for the three ways d_k from the first site to the others.
reference::Point circumcenter(const std::vector<GridPoint>& sites, const Word4& name) {
    const GridPoint& q = sites[name[0]];
    const Row a = minus(sites[name[1]], q), b = minus(sites[name[2]], q), c = minus(sites[name[3]], q);
    const Row bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    reference::Point center;
    for (size_t k = 0; k < 3; ++k)
        center[k] = static_cast<double>(q[k] + (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / (2 * dot(a, bc)));
    return center;
}

void expectDepths(const DeviceEvent& event) {
    const std::vector<GridPoint> sites = event.sites();
    const reference::Triangles triangles = event.triangles();
    const uint32_t n = event[COUNT_VORONOI_VERTICES];
    const auto names = event.read<Word4>(event.buffers().vertex_sites, n);
    const auto links = event.read<Word2>(event.buffers().other_links, n); // seven rounds end there
    for (uint32_t v = 0; v < n; ++v) {
        const long double winding = reference::windingNumber(triangles, circumcenter(sites, names[v]));
        ASSERT_EQ(links[v][0], NO_INDEX);
        ASSERT_NEAR(static_cast<int32_t>(links[v][1]), static_cast<double>(winding), 1e-3) << "Voronoi vertex " << v;
    }
}

struct TripleOnEdge {
    long double along; // the edge's direction, which leads from start to end
    bool leaves;       // the solid
};

// Where a triple point lies on its Voronoi edge, and which way the surface is passed there.
TripleOnEdge onEdge(const Polygons& p, const Word4& triple) {
    const auto [t, i, j, k] = triple;
    const Row u = minus(p.sites[j], p.sites[i]), w = minus(p.sites[k], p.sites[i]), direction = cross(u, w);
    const Row normal = cross(minus(p.corner(t, 1), p.corner(t, 0)), minus(p.corner(t, 2), p.corner(t, 0)));
    const LongPoint place = placeOf(p, t, meetingPoint(p, t, i, j, k));
    const Row from_site = {place[0] - p.sites[i][0], place[1] - p.sites[i][1], place[2] - p.sites[i][2]};
    return {dot(from_site, direction) / std::sqrt(dot(direction, direction)), dot(normal, direction) > 0};
}

void expectOrdered(const DeviceEvent& event) {
    const Polygons p{event};
    const uint32_t edges = event[COUNT_VORONOI_EDGES], n = event[COUNT_TRIPLES];
    if (n == 0) return;
    const auto names = event.read<Word4>(event.buffers().edge_sites, edges);
    const auto offsets = event.read<uint32_t>(event.buffers().edge_triple_offsets, edges + 1);
    const auto triples = event.read<Word4>(event.buffers().triples, n);
    const auto signs = event.read<int32_t>(event.buffers().triple_signs, n);
    const auto ordered = event.read<Word2>(event.buffers().ordered_triples, n);
    std::vector<bool> seen(n, false);
    for (uint32_t e = 0; e < edges; ++e) {
        long double last = -1e30L;
        for (uint32_t at = offsets[e]; at < offsets[e + 1]; ++at) {
            const uint32_t triple = ordered[at][0];
            ASSERT_FALSE(seen[triple]);
            seen[triple] = true;
            ASSERT_EQ((std::array{triples[triple][1], triples[triple][2], triples[triple][3]}),
                      (std::array{names[e][0], names[e][1], names[e][2]}));
            const TripleOnEdge here = onEdge(p, triples[triple]);
            ASSERT_EQ(signs[triple], here.leaves ? 1 : -1);
            ASSERT_GE(here.along, last - 1e-3L) << "Voronoi edge " << e;
            last = here.along;
        }
    }
    EXPECT_EQ(offsets[edges], n);
}

void expectDepth(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Depth);
    expectDepths(event);
    expectOrdered(event);
}

// Vertices inside and outside alike: sites far around the model.
FractureOptions sitesAround(uint32_t count, double reach) {
    std::mt19937 random(count);
    std::uniform_real_distribution<double> coordinate(-reach, reach);
    FractureOptions options;
    for (uint32_t s = 0; s < count; ++s)
        options.given_sites.push_back({coordinate(random), coordinate(random), coordinate(random)});
    return options;
}

TEST(SmallDepth, OfVoronoiVerticesIsTheWindingNumber) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 5u, 63u, 64u, 65u})
        expectDepth(bumpy, {count, count, {}});
}

TEST(SmallDepth, OfVoronoiVerticesFarAndNear) { expectDepth(solidOf("cube"), sitesAround(300, 1)); }
TEST(Depth, OfManyVoronoiVertices) { expectDepth(solidOf("bumpy:2"), {1234, 5, {}}); }
TEST(Depth, InARing) { expectDepth(solidOf("ring"), sitesAround(250, 1.2)); }

// Edges pass in and out several times.
TEST(Depth, InShellsWithinShells) {
    reference::Triangles shells;
    for (int k = 0; k < 4; ++k) {
        const double r = 10 - 2 * k;
        const reference::Triangles box = support::boxTriangles({-r, -r, -r}, {r, r, r});
        shells = support::joined(shells, k % 2 == 0 ? box : support::turnedOver(box));
    }
    expectDepth(solidOf(shells), sitesAround(200, 12));
    expectDepth(solidOf(shells), sitesAround(4, 12));
}

// Voronoi edges run along the axes, and many vertices are one place: x, y and z decide in turn which way is up.
TEST(SmallDepth, InALattice) {
    for (const double apart : {.25, .4, .6}) {
        FractureOptions options = latticeSites(apart);
        for (uint32_t seed = 0; seed < 4; ++seed) {
            std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(seed));
            expectDepth(solidOf("cube"), options);
        }
    }
}

// Chains of links with a depth at each: lengths of one, around a workgroup, and longer than a round reaches.
TEST(SmallDepth, IsAddedUpAlongTheLinks) {
    constexpr uint32_t kRounds = 7;
    for (const uint32_t n : {1u, 63u, 64u, 65u, 1234u, 50'000u}) {
        std::vector<Word2> links, expected(n);
        for (uint32_t v = 0; v < n; ++v)
            links.push_back({v % 1000 == 999 && n < 2000 ? NO_INDEX : v + 1, v * 2654435761u >> 30});
        links.back()[0] = NO_INDEX;
        for (uint32_t v = n; v-- > 0;) {
            const bool ends = links[v][0] == NO_INDEX;
            expected[v] = {NO_INDEX, links[v][1] + (ends ? 0 : expected[v + 1][1])};
        }
        Counts counts;
        counts[COUNT_VORONOI_VERTICES] = n;
        const engine::Buffer a = bufferOf(links), b = blankBuffer<Word2>(n);
        onDevice([&](engine::Commands& commands) {
            for (uint32_t round = 0; round < kRounds; ++round)
                commands.dispatch(kernel("jump_depth"), n, uint32_t{round + 1 == kRounds},
                                  {counts.words, round % 2 == 0 ? a : b, round % 2 == 0 ? b : a});
        });
        EXPECT_EQ(valuesOf<Word2>(b, n), expected);
        EXPECT_EQ(counts[STATUS_BAD_DEPTH], 0u);
    }
}

// A ring of links has no end: that must not go unnoticed.
TEST(SmallDepth, WithoutAnEndIsCounted) {
    Counts counts;
    counts[COUNT_VORONOI_VERTICES] = 3;
    const engine::Buffer links = bufferOf<Word2>({{1, 0}, {0, 0}, {NO_INDEX, 0}}), next = blankBuffer<Word2>(3);
    onDevice([&](engine::Commands& commands) {
        commands.dispatch(kernel("jump_depth"), 3, uint32_t{1}, {counts.words, links, next});
    });
    EXPECT_EQ(counts[STATUS_BAD_DEPTH], 2u);
}

} // namespace
} // namespace kernel_test
