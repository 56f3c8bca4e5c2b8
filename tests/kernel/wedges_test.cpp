// weld_corners, name_sides, weld_sides, link_sides and pair_wedges: around an edge where solids touch, the two triangles of
// each solid find each other. The solids are drawn at random, so what belongs together is known.
#include "modules/brittle/fracture/event.h"
#include "tests/kernel/lab.h"
#include "tests/reference/geometry.h"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace kernel_test {
namespace {

using Triangle = std::array<uint32_t, 3>;
using reference::Point;
using reference::operator+;
using reference::operator*;

struct Soup {
    std::vector<Int4> places; // on the grid
    std::vector<Triangle> triangles;
    std::map<uint32_t, uint32_t> mates; // of the sides at the edge
};

// Triangles around one edge, each with corners of its own.
class EdgeOfSolids {
public:
    explicit EdgeOfSolids(uint32_t seed) : random_(seed) {
        low_ = {fraction() * 9e6, fraction() * 9e6, fraction() * 9e6};
        const Point way = {fraction() - 0.5, fraction() - 0.5, fraction() - 0.5};
        const double length = std::sqrt(reference::dot(way, way));
        high_ = onGrid(low_ + (std::exp2(12 + 9 * fraction()) / length) * way);
        low_ = onGrid(low_);
        const Point axis = high_ + -1.0 * low_;
        along_ = (1 / std::sqrt(reference::dot(axis, axis))) * axis;
        const Point other = std::abs(along_[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
        u_ = reference::cross(along_, other);
        u_ = (1 / std::sqrt(reference::dot(u_, u_))) * u_;
        v_ = reference::cross(along_, u_);
    }

    double fraction() { return static_cast<double>(random_() % 100'000) / 100'000; }

    // The solid fills the angles between.
    void addSolid(double from, double to) {
        const uint32_t opening = addTriangle(high_, low_, from), closing = addTriangle(low_, high_, to);
        soup_.mates[opening] = closing;
        soup_.mates[closing] = opening;
    }
    const Soup& soup() const { return soup_; }

private:
    static Point onGrid(const Point& p) { return {std::nearbyint(p[0]), std::nearbyint(p[1]), std::nearbyint(p[2])}; }

    uint32_t addPlace(const Point& p) {
        const auto at = [&](size_t k) { return static_cast<int32_t>(std::nearbyint(p[k])) + (1 << 22); };
        soup_.places.push_back({at(0), at(1), at(2), 0});
        return static_cast<uint32_t>(soup_.places.size()) - 1;
    }

    // Returns the side from the first end to the second. Distances from the edge are such that a grid step is far less than a
    // gap.
    uint32_t addTriangle(const Point& from, const Point& to, double angle) {
        const double distance = std::exp2(14 + 7 * fraction());
        const Point apex = low_ + (3 * (fraction() - 0.5) * distance) * along_ + (distance * std::cos(angle)) * u_ +
                           (distance * std::sin(angle)) * v_;
        const Triangle corners = {addPlace(from), addPlace(to), addPlace(apex)};
        const auto turn = static_cast<uint32_t>(random_() % 3), number = static_cast<uint32_t>(soup_.triangles.size());
        soup_.triangles.push_back({corners[turn], corners[(turn + 1) % 3], corners[(turn + 2) % 3]});
        return 3 * number + (3 - turn) % 3;
    }

    std::mt19937 random_;
    Point low_, high_, along_, u_, v_;
    Soup soup_;
};

// Solids and gaps of random angles; between some there is no gap, and one face lies on another but for rounding.
Soup solidsAround(uint32_t count, uint32_t seed) {
    EdgeOfSolids edge(seed);
    std::vector<double> solids, gaps;
    double sum = 0;
    for (uint32_t k = 0; k < count; ++k) {
        solids.push_back(0.1 + edge.fraction());
        gaps.push_back(edge.fraction() < 0.4 ? 0 : 0.1 + edge.fraction());
        sum += solids.back() + gaps.back();
    }
    double at = 7 * edge.fraction();
    const double scale = 2 * std::numbers::pi / sum;
    for (uint32_t k = 0; k < count; ++k) {
        edge.addSolid(at, at + scale * solids[k]);
        at += scale * (solids[k] + gaps[k]);
    }
    return edge.soup();
}

std::vector<uint32_t> wedgesOf(const Soup& soup) {
    const auto vertices = static_cast<uint32_t>(soup.places.size()), triangles = static_cast<uint32_t>(soup.triangles.size());
    brittle::Capacities capacity;
    capacity.vertices = vertices;
    capacity.triangles = triangles;
    capacity.touching = true;
    const engine::Buffer places = bufferOf(soup.places), corners = bufferOf(soup.triangles);
    const auto words = [&](size_t count) { return blankBuffer<uint32_t>(count); };
    const size_t sides = 3 * triangles;
    const engine::Buffer table = words(64 << 4), slots = words(sides), flags = words(sides), first_vertices = words(sides),
                         named = words(2 * sides), first_sides = words(sides), heads = words(sides), links = words(sides),
                         open = words(sides), wedges = words(sides);
    brittle::EventBuffers b;
    b.grid_vertices = places;
    b.mesh_triangles = corners;
    b.place_table = table;
    b.place_slots = slots;
    b.place_flags = flags;
    b.first_vertices = first_vertices;
    b.named_sides = named;
    b.first_sides = first_sides;
    b.side_heads = heads;
    b.side_links = links;
    b.open_wedges = open;
    b.wedges = wedges;
    Counts counts;
    counts[COUNT_MESH_VERTICES] = vertices;
    counts[COUNT_MESH_TRIANGLES] = triangles;
    counts[COUNT_MESH_CORNERS] = 3 * triangles;
    onDevice([&](engine::Commands& commands) {
        brittle::Recorder record(commands, kernels(), counts.words, counts.args);
        for (const uint32_t count :
             {uint32_t{COUNT_MESH_VERTICES}, uint32_t{COUNT_MESH_TRIANGLES}, uint32_t{COUNT_MESH_CORNERS}})
            record.publish(count, NO_INDEX);
        const brittle::EventGrid grid;
        brittle::recordWedges({.grid = grid, .capacity = capacity, .b = b, .scene = {}, .record = record});
    });
    EXPECT_EQ(counts[STATUS_FAILED], 0u);
    return valuesOf<uint32_t>(wedges, sides);
}

void expectMates(const Soup& soup) {
    const std::vector<uint32_t> wedges = wedgesOf(soup);
    for (uint32_t side = 0; side < wedges.size(); ++side) {
        const auto mate = soup.mates.find(side);
        EXPECT_EQ(wedges[side], mate == soup.mates.end() ? side : std::min(side, mate->second)) << side;
    }
}

} // namespace

TEST(Wedges, TwoTrianglesOfASolidFindEachOther) {
    for (uint32_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(seed);
        expectMates(solidsAround(2 + seed % 9, seed));
        if (testing::Test::HasFailure()) return;
    }
}

TEST(Wedges, ManySolidsMayTouchAtAnEdge) { expectMates(solidsAround(40, 1)); }

TEST(Wedges, TwoTrianglesBoundOneWedge) { expectMates(solidsAround(1, 5)); }

TEST(Wedges, MoreThanSixtyFourSolidsAtAnEdgeAreOneWedge) {
    const Soup soup = solidsAround(65, 1);
    const std::vector<uint32_t> wedges = wedgesOf(soup);
    const uint32_t lowest = soup.mates.begin()->first;
    for (const auto& [side, mate] : soup.mates)
        EXPECT_EQ(wedges[side], lowest) << side;
}

} // namespace kernel_test
