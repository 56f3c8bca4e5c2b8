// number_corners, place_crossings, place_triples, place_voronoi, weld_points and resolve_points: every corner of a clipped
// polygon has a name, and what bears the name lies where the polygon's sides meet.
#include "tests/kernel/clipped_polygons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace kernel_test {
namespace {

using brittle::FractureOptions;
using FixedPoint = std::array<int64_t, 3>; // grid steps, 24 binary places

struct Places {
    const DeviceEvent& event;
    uint32_t count = event[COUNT_POINTS];
    std::vector<FixedPoint> points = event.read<FixedPoint>(event.buffers().points, count);
    std::vector<std::array<float, 4>> positions = event.read<std::array<float, 4>>(event.buffers().positions, count);
    std::vector<uint32_t> welded = event.read<uint32_t>(event.buffers().welded, count);

    LongPoint onGrid(uint32_t id) const {
        return {points[id][0] * 0x1p-24L, points[id][1] * 0x1p-24L, points[id][2] * 0x1p-24L};
    }
    // The place in the model, as the grid would have it.
    LongPoint positionOnGrid(uint32_t id) const {
        LongPoint p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = static_cast<long double>(positions[id][k]) * static_cast<long double>(event.grid().scale) + (1 << 23);
        return p;
    }
};

double distance(const LongPoint& a, const LongPoint& b) {
    return static_cast<double>(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

// The fixed-point place is as good as its fractions of 2^-32 of an edge; the model's vertices are not those of the grid, and
// floats, but less than three steps from it.
void expectPlace(const Places& places, uint32_t id, const LongPoint& place) {
    ASSERT_LT(id, places.count);
    ASSERT_LT(distance(places.onGrid(id), place), 0.05) << "point " << id;
    ASSERT_LT(distance(places.positionOnGrid(id), place), 3) << "point " << id;
}

// Also that names differ where they should: a vertex of the mesh, a crossing or a triple point, by their sides.
void expectCorners(const Places& places, const Polygons& p) {
    const uint32_t crossings = p.event.vertexCount(), triples = crossings + p.event[COUNT_CROSSINGS];
    const auto corners = p.event.read<uint32_t>(p.event.buffers().polygon_corners, p.event[COUNT_SIDES]);
    for (uint32_t q = 0; q < p.count; ++q) {
        const std::vector<Weights> weights = cornersOf(p, q);
        for (uint32_t k = 0; k < p.sideCount(q); ++k) {
            const uint32_t id = corners[p.offsets[q][0] + k];
            const int edges = (p.side(q, k) >= EDGE_BASE) + (p.side(q, k + 1) >= EDGE_BASE);
            ASSERT_EQ(edges, id < crossings ? 2 : (id < triples ? 1 : 0)) << "polygon " << q;
            expectPlace(places, id, placeOf(p, p.polygons[q][0], weights[k]));
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

void expectVertices(const Places& places) {
    const std::vector<reference::GridPoint> vertices = places.event.vertices();
    for (uint32_t v = 0; v < vertices.size(); ++v) {
        for (size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(places.points[v][k], int64_t{vertices[v][k]} << 24);
            ASSERT_EQ(places.positions[v][k], places.event.mesh().positions[v][k]);
        }
    }
}

// All four sites of a Voronoi vertex are equally near.
void expectVoronoiVertices(const Places& places) {
    const DeviceEvent& event = places.event;
    const std::vector<reference::GridPoint> sites = event.sites();
    const uint32_t first = event.vertexCount() + event[COUNT_CROSSINGS] + event[COUNT_TRIPLES];
    const auto names = event.read<Word4>(event.buffers().vertex_sites, event[COUNT_VORONOI_VERTICES]);
    ASSERT_EQ(places.count, first + names.size());
    for (uint32_t v = 0; v < names.size(); ++v) {
        const LongPoint place = places.onGrid(first + v);
        std::array<double, 4> apart;
        for (size_t k = 0; k < 4; ++k) {
            const reference::GridPoint& s = sites[names[v][k]];
            apart[k] = distance(
                place, {static_cast<long double>(s[0]), static_cast<long double>(s[1]), static_cast<long double>(s[2])});
        }
        const auto [nearest, furthest] = std::minmax_element(apart.begin(), apart.end());
        ASSERT_LT(*furthest - *nearest, 1e-5) << "Voronoi vertex " << v;
        ASSERT_LT(distance(places.positionOnGrid(first + v), place), 2) << "Voronoi vertex " << v;
    }
}

void expectWelded(const Places& places) {
    std::map<FixedPoint, uint32_t> lowest;
    for (uint32_t id = 0; id < places.count; ++id)
        ASSERT_EQ(places.welded[id], lowest.try_emplace(places.points[id], id).first->second) << "point " << id;
}

void expectPlaced(const brittle::PreparedMesh& solid, const FractureOptions& options) {
    SCOPED_TRACE(options.given_sites.empty() ? options.site_count : options.given_sites.size());
    const DeviceEvent event(solid, options, Until::Places);
    const Places places{event};
    expectVertices(places);
    expectCorners(places, {event});
    expectVoronoiVertices(places);
    expectWelded(places);
}

TEST(SmallPlaces, AreWhereTheSidesOfPolygonsMeet) {
    const brittle::PreparedMesh bumpy = solidOf("bumpy:1");
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u})
        expectPlaced(bumpy, {count, count, {}});
}

TEST(Places, OnLargeTriangles) { expectPlaced(solidOf("cube"), {1234, 2, {}}); }
TEST(Places, OnARing) { expectPlaced(solidOf("ring"), {200, 3, {}}); }

// Eight cells and more meet in a place: its many names are welded into one.
TEST(SmallPlaces, InALatticeAreWelded) {
    FractureOptions options = latticeSites(.25);
    std::shuffle(options.given_sites.begin(), options.given_sites.end(), std::mt19937(1));
    const DeviceEvent event(solidOf("cube"), options, Until::Places);
    const Places places{event};
    expectVoronoiVertices(places);
    expectWelded(places);
    std::map<uint32_t, uint32_t> names;
    for (uint32_t id = event.vertexCount() + event[COUNT_CROSSINGS] + event[COUNT_TRIPLES]; id < places.count; ++id)
        ++names[places.welded[id]];
    uint32_t inside = 0;
    for (const auto& [id, count] : names)
        inside += count > 1 ? 1 : 0;
    EXPECT_EQ(names.size(), 27u);
    EXPECT_EQ(inside, 27u);
}

} // namespace
} // namespace kernel_test
