// own_vertices, flag_edges, cross_edges and classify_triangles, against all sites one by one, in whole numbers. Where a mesh
// edge passes from cell to cell is checked as fractions of its length: at each crossing the two cells must be equally near,
// and no other site nearer. Cells are convex, so that this leaves one sequence alone.
#include "tests/kernel/device_event.h"
#include "tests/reference/big_int.h"
#include "tests/reference/predicates.h"

#include <algorithm>
#include <random>
#include <set>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using reference::BigInt;
using reference::GridPoint;

constexpr uint32_t kTied = 0x80000000u;

struct Owners {
    const DeviceEvent& event;
    std::vector<GridPoint> sites = event.sites(), vertices = event.vertices();
    std::vector<uint32_t> words = event.read<uint32_t>(event.buffers().owners, event.vertexCount());
    uint32_t of(uint32_t v) const { return words[v] & ~kTied; }
    bool tied(uint32_t v) const { return (words[v] & kTied) != 0; }
    bool mixed(const std::array<uint32_t, 2>& edge) const { return of(edge[0]) != of(edge[1]); }
};

// Sites on a lattice about the middle of the cube, whose bisectors run along the planes of its edges and its diagonals.
FractureOptions latticeSites(uint32_t per_axis, double apart) {
    FractureOptions options;
    for (uint32_t s = 0; s < per_axis * per_axis * per_axis; ++s) {
        const uint32_t at[] = {s % per_axis, s / per_axis % per_axis, s / per_axis / per_axis};
        brittle::Double3 p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = (static_cast<double>(at[k]) - (per_axis - 1) / 2.0) * apart;
        options.given_sites.push_back(p);
    }
    return options;
}

void expectOwners(const Owners& owners) {
    for (uint32_t v = 0; v < owners.vertices.size(); ++v) {
        const uint32_t nearest = reference::nearestSite(owners.sites, owners.vertices[v]);
        bool tied = false;
        for (uint32_t s = 0; s < owners.sites.size(); ++s)
            tied =
                tied || (s != nearest && reference::nearness(owners.sites[nearest], owners.sites[s], owners.vertices[v]) == 0);
        ASSERT_EQ(owners.of(v), nearest) << "vertex " << v;
        ASSERT_EQ(owners.tied(v), tied) << "vertex " << v;
    }
}

// The edges whose ends have different owners, in their own order; and the slot of every edge among them.
void expectMixedEdges(const Owners& owners) {
    const DeviceEvent& event = owners.event;
    std::vector<uint32_t> expected, slots;
    for (uint32_t e = 0; e < event.edgeCount(); ++e) {
        slots.push_back(static_cast<uint32_t>(expected.size()));
        if (owners.mixed(event.topology().edges[e])) expected.push_back(e);
    }
    slots.push_back(static_cast<uint32_t>(expected.size()));
    EXPECT_EQ(event.read<uint32_t>(event.buffers().edge_slot, slots.size()), slots);
    EXPECT_EQ(event[COUNT_MIXED_EDGES], expected.size());
    EXPECT_EQ(event.read<uint32_t>(event.buffers().mixed_edges, expected.size()), expected);
}

void expectMixedTriangles(const Owners& owners) {
    const DeviceEvent& event = owners.event;
    std::vector<uint32_t> expected;
    for (uint32_t t = 0; t < event.triangleCount(); ++t) {
        const brittle::Index3& v = event.mesh().triangles[t];
        const bool mixed = owners.mixed({v[0], v[1]}) || owners.mixed({v[1], v[2]}) || owners.mixed({v[2], v[0]});
        if (mixed || (owners.tied(v[0]) && owners.tied(v[1]) && owners.tied(v[2]))) expected.push_back(t);
    }
    EXPECT_EQ(event[COUNT_MIXED_TRIANGLES], expected.size());
    EXPECT_EQ(event.read<uint32_t>(event.buffers().mixed_triangles, expected.size()), expected);
}

// The place on an edge where two sites are equally near, as a fraction of its length.
struct Share {
    BigInt num, den; // den > 0
    bool operator<(const Share& other) const { return num * other.den < other.num * den; }
};

struct Segment {
    GridPoint a, b;
    Share equallyNear(const GridPoint& from, const GridPoint& to) const {
        const int64_t at_a = reference::nearness(from, to, a), at_b = reference::nearness(from, to, b);
        return {BigInt(at_a), BigInt(at_a - at_b)};
    }
    // How much nearer to `self` than to `site` the place is, times a positive number.
    BigInt nearness(const GridPoint& self, const GridPoint& site, const Share& place) const {
        const int64_t at_a = reference::nearness(self, site, a), at_b = reference::nearness(self, site, b);
        return BigInt(at_a) * (place.den - place.num) + BigInt(at_b) * place.num;
    }
};

void expectCrossing(const Owners& owners, const Segment& segment, const Word4& crossing, Share& last) {
    const GridPoint &from = owners.sites[crossing[0]], &to = owners.sites[crossing[1]];
    const Share place = segment.equallyNear(from, to);
    // Along a bisector the edge passes where ties are broken, which is anywhere.
    if (place.den.sign() == 0) {
        ASSERT_EQ(place.num.sign(), 0);
        return;
    }
    ASSERT_GT(place.den.sign(), 0);
    ASSERT_GE(place.num.sign(), 0);
    ASSERT_GE((place.den - place.num).sign(), 0);
    ASSERT_FALSE(place < last);
    last = place;
    for (const GridPoint& site : owners.sites)
        ASSERT_GE(segment.nearness(from, site, place).sign(), 0);
}

void expectCrossings(const Owners& owners) {
    const DeviceEvent& event = owners.event;
    const uint32_t mixed = event[COUNT_MIXED_EDGES];
    if (mixed == 0) return; // an empty list has no offsets
    const auto edges = event.read<uint32_t>(event.buffers().mixed_edges, mixed);
    const auto offsets = event.read<uint32_t>(event.buffers().crossing_offsets, mixed + 1);
    const auto crossings = event.read<Word4>(event.buffers().crossings, event[COUNT_CROSSINGS]);
    ASSERT_EQ(offsets[0], 0u);
    ASSERT_EQ(offsets[mixed], crossings.size());
    for (uint32_t m = 0; m < mixed; ++m) {
        const auto ends = event.topology().edges[edges[m]];
        uint32_t at = owners.of(ends[0]);
        std::set<uint32_t> seen = {at};
        Share last = {BigInt(0), BigInt(1)};
        for (uint32_t c = offsets[m]; c < offsets[m + 1]; ++c) {
            ASSERT_EQ(crossings[c][0], at);
            ASSERT_EQ(crossings[c][2], edges[m]);
            at = crossings[c][1];
            ASSERT_TRUE(seen.insert(at).second) << "edge " << edges[m] << " comes back to cell " << at;
            expectCrossing(owners, {owners.vertices[ends[0]], owners.vertices[ends[1]]}, crossings[c], last);
            if (testing::Test::HasFatalFailure()) return;
        }
        ASSERT_EQ(at, owners.of(ends[1])) << "edge " << edges[m];
    }
}

void expectClassified(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Classification);
    const Owners owners{event};
    expectOwners(owners);
    if (testing::Test::HasFatalFailure()) return;
    expectMixedEdges(owners);
    expectMixedTriangles(owners);
    expectCrossings(owners);
}

TEST(SmallOwnership, IsThatOfTheNearestSite) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:2");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectClassified(bumpy, {count, count, {}});
}

TEST(Ownership, OfAFineMeshAmongFewSites) { expectClassified(solidOf("bumpy:4"), {7, 1, {}}); }
TEST(Ownership, OfACoarseMeshAmongManySites) { expectClassified(solidOf("cube"), {1234, 2, {}}); }
TEST(Ownership, OfARing) { expectClassified(solidOf("ring"), {200, 3, {}}); }

TEST(SmallOwnership, OfTiesIsTheLowerSites) {
    for (const uint32_t per_axis : {2u, 3u, 4u, 5u})
        expectClassified(solidOf("cube"), latticeSites(per_axis, .25));
}

// With sites a quarter beside every face: the corners are tied among eight sites, and the faces lie in bisectors.
TEST(SmallOwnership, OfAFaceInABisectorIsTheLowerSites) {
    FractureOptions options = latticeSites(4, .5);
    expectClassified(solidOf("cube"), options);
    for (uint32_t seed = 0; seed < 5; ++seed) {
        std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(seed));
        expectClassified(solidOf("cube"), options);
    }
    const DeviceEvent event(solidOf("cube"), options, Until::Classification);
    EXPECT_EQ(event[COUNT_MIXED_TRIANGLES], 12u);
}

// Two sites, one above and one below the top: four corners are tied and no edge is cut, and yet the top is not whole.
TEST(SmallOwnership, OfAFaceBetweenTwoSitesIsMixedThoughNoEdgeIs) {
    for (const double first : {.25, .75}) {
        const FractureOptions options{0, 0, {{0, 0, first}, {0, 0, 1 - first}}};
        expectClassified(solidOf("cube"), options);
        EXPECT_EQ(DeviceEvent(solidOf("cube"), options, Until::Classification)[COUNT_MIXED_TRIANGLES], first < .5 ? 2u : 10u);
    }
}

} // namespace
} // namespace kernel_test
