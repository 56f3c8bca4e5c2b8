// seed_pairs, clip_triangles, place_polygons, order_polygons and list_triples: the polygons of a triangle tile it, each in its
// own cell, and every triple point is written once.
#include "tests/kernel/clipped_polygons.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using reference::GridPoint;
using Triple = std::array<uint32_t, 4>; // triangle, three sites in order

// In units of the triangle's, by the first two weights.
long double shareOfArea(const std::vector<Weights>& corners) {
    long double sum = 0;
    for (size_t k = 0; k < corners.size(); ++k) {
        const Weights &a = corners[k], &b = corners[(k + 1) % corners.size()];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum;
}

// How far a corner lies beyond the bisector that it passes furthest, in grid steps.
double outside(const Polygons& p, uint32_t q, const Weights& weights) {
    const auto [t, cell, flat, pair] = p.polygons[q];
    const LongPoint place = placeOf(p, t, weights);
    std::vector<reference::Point> sites;
    for (const GridPoint& site : p.sites)
        sites.push_back({double(site[0]), double(site[1]), double(site[2])});
    return reference::distanceOutsideCell(sites, cell, {double(place[0]), double(place[1]), double(place[2])});
}

void expectInTheirCells(const Polygons& p) {
    for (uint32_t q = 0; q < p.count; ++q)
        for (const Weights& corner : cornersOf(p, q)) {
            for (const long double w : corner)
                ASSERT_GE(w, -1e-9L) << "polygon " << q;
            ASSERT_LE(outside(p, q, corner), 1e-3) << "polygon " << q;
        }
}

void expectTiles(const Polygons& p) {
    std::map<uint32_t, long double> covered;
    for (uint32_t q = 0; q < p.count; ++q) {
        const long double share = shareOfArea(cornersOf(p, q));
        ASSERT_GE(share, -1e-12L) << "polygon " << q;
        covered[p.polygons[q][0]] += share;
    }
    ASSERT_EQ(covered.size(), p.event[COUNT_MIXED_TRIANGLES]);
    for (const auto& [triangle, share] : covered)
        ASSERT_NEAR(static_cast<double>(share), 1, 1e-9) << "triangle " << triangle;
}

// By triangle, then by cell; at most one of each.
void expectOrdered(const Polygons& p) {
    for (uint32_t q = 1; q < p.count; ++q) {
        const Word4 &a = p.polygons[q - 1], &b = p.polygons[q];
        ASSERT_LT(std::pair(a[0], a[1]), std::pair(b[0], b[1])) << "polygon " << q;
    }
}

// Every corner of two bisectors is one triple point, on a list of its own, and three polygons have it.
void expectTriples(const Polygons& p) {
    std::map<Triple, uint32_t> visits;
    for (uint32_t q = 0; q < p.count; ++q)
        for (uint32_t k = 0; k < p.sideCount(q); ++k) {
            Triple name = {p.polygons[q][0], p.polygons[q][1], p.side(q, k), p.side(q, k + 1)};
            std::sort(name.begin() + 1, name.end());
            if (name[3] < EDGE_BASE) ++visits[name];
        }
    ASSERT_EQ(p.event[COUNT_TRIPLES], visits.size());
    for (const Triple& written : p.event.read<Triple>(p.event.buffers().triples, p.event[COUNT_TRIPLES]))
        ASSERT_EQ(visits[written], 3u);
}

void expectCounts(const Polygons& p) {
    uint32_t fans = 0, sides = 0;
    for (uint32_t q = 0; q < p.count; ++q) {
        ASSERT_EQ(p.offsets[q][0], sides);
        ASSERT_EQ(p.offsets[q][3], fans);
        ASSERT_GE(p.sideCount(q), 3u);
        sides += p.sideCount(q);
        fans += p.sideCount(q) - 2;
    }
    EXPECT_EQ(p.event[COUNT_SIDES], sides);
    EXPECT_EQ(p.event[COUNT_FAN_TRIANGLES], fans);
}

void expectClipped(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Clipping);
    const Polygons polygons{event};
    for (const auto& expect : {expectCounts, expectOrdered, expectTiles, expectInTheirCells, expectTriples}) {
        expect(polygons);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(SmallClipping, OfATriangleGivesPolygonsThatTileIt) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectClipped(bumpy, {count, count, {}});
}

// Nearly all polygons lie inside large triangles, and are found in many rounds.
TEST(Clipping, OfLargeTrianglesGoesOnUntilTheyAreTiled) { expectClipped(solidOf("cube"), {.site_count = 1234, .seed = 2}); }
TEST(Clipping, OfAFineMesh) { expectClipped(solidOf("bumpy:4"), {.site_count = 100, .seed = 3}); }
TEST(Clipping, OfARing) { expectClipped(solidOf("ring"), {.site_count = 200, .seed = 3}); }

FractureOptions shuffledLattice(double apart, uint32_t seed) {
    FractureOptions options = latticeSites(apart);
    std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(seed));
    return options;
}

// All bisectors meet in the places of the lattice: which polygon gets how many sides is up to the ties.
TEST(SmallClipping, OfALatticeTilesTheCube) {
    for (uint32_t seed = 0; seed < 5; ++seed)
        expectClipped(solidOf("cube"), shuffledLattice(.25, seed));
}

// The faces of the cube lie in bisectors, and so do its edges.
TEST(SmallClipping, OfFacesInBisectorsTilesTheCube) {
    for (uint32_t seed = 0; seed < 5; ++seed)
        expectClipped(solidOf("cube"), shuffledLattice(.5, seed));
}

// The top lies in the bisector of a site below it and one above. It goes to the lower site's cell, marked where that is the
// one above: the solid is on the other side.
TEST(SmallClipping, MarksPolygonsThatBelongToTheOtherSideOfTheirBisector) {
    for (const double first : {.25, .75}) {
        const DeviceEvent event(solidOf("cube"), {0, 0, {{0, 0, first}, {0, 0, 1 - first}}}, Until::Clipping);
        const Polygons p{event};
        uint32_t flat = 0;
        for (const Word4& polygon : p.polygons) {
            if (polygon[2] == NO_INDEX) continue;
            ++flat;
            EXPECT_EQ(polygon[1], 0u);
            EXPECT_EQ(polygon[2], 1u);
        }
        EXPECT_EQ(flat, first < .5 ? 0u : 2u);
    }
}

} // namespace
} // namespace kernel_test
