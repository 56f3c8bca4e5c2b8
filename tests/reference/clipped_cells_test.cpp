// The double-precision cells against closed forms and against the exact diagram.
#include "tests/reference/clipped_cells.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace {

using namespace reference;

std::vector<Point> randomSites(uint32_t count) {
    std::mt19937_64 random(5);
    std::vector<Point> sites(count);
    for (Point& site : sites)
        for (double& x : site)
            x = static_cast<double>(random() % 1'000'000) * 1e-6;
    return sites;
}

double sumOf(const std::vector<Polyhedron>& cells) {
    return std::accumulate(cells.begin(), cells.end(), 0.0, [](double sum, const Polyhedron& c) { return sum + volumeOf(c); });
}

const Bounds kUnitBox = {{0, 0, 0}, {1, 1, 1}};

TEST(ClippedCells, ABoxInHalvesIsTwoHalves) {
    Polyhedron box = boxOf({{0, 0, 0}, {2, 1, 1}});
    EXPECT_DOUBLE_EQ(volumeOf(box), 2);
    cut(box, {1, 0, 0}, 0.5, 7);
    EXPECT_DOUBLE_EQ(volumeOf(box), 0.5);
    ASSERT_EQ(box.faces.back().id, 7u);
    EXPECT_DOUBLE_EQ(areaOf(box.faces.back()), 1);
    cut(box, {1, 0, 0}, -1, 8);
    EXPECT_TRUE(box.faces.empty());
}

TEST(ClippedCells, FillTheBoxAlsoWhereEverythingTies) {
    EXPECT_NEAR(sumOf(voronoiCells(randomSites(200), kUnitBox)), 1, 1e-13);
    std::vector<Point> lattice;
    for (int k = 0; k < 64; ++k)
        lattice.push_back({0.125 + 0.25 * (k % 4), 0.125 + 0.25 * (k / 4 % 4), 0.125 + 0.25 * (k / 16)});
    for (const Polyhedron& cell : voronoiCells(lattice, kUnitBox))
        EXPECT_NEAR(volumeOf(cell), 1.0 / 64, 1e-15);
}

TEST(ClippedCells, AreThoseOfTheExactDiagram) {
    SiteSet set;
    set.box = {{0, 0, 0}, {1'000'000, 1'000'000, 1'000'000}};
    std::vector<Point> sites = randomSites(120);
    for (const Point& p : sites)
        set.sites.push_back({int32_t(p[0] * 1e6 + .5), int32_t(p[1] * 1e6 + .5), int32_t(p[2] * 1e6 + .5)});
    const auto exact = cutAllCells(set);
    const auto cells = voronoiCells(sites, kUnitBox);
    ASSERT_EQ(cells.size(), exact.size());
    for (size_t k = 0; k < cells.size(); ++k)
        EXPECT_NEAR(volumeOf(cells[k]), cellVolume(exact[k]) * 1e-18, 1e-13);
}

TEST(ClippedCells, AModelThatIsNotConvexIsShared) {
    const Triangles big = support::boxTriangles({0, 0, 0}, {1, 1, 1});
    const Triangles hollow = support::joined(big, support::turnedOver(support::boxTriangles({.25, .25, .25}, {.75, .75, .75})));
    const std::vector<Point> halves = {{.25, .5, .5}, {.75, .5, .5}};
    for (const double volume : volumesWithin(hollow, voronoiCells(halves, kUnitBox)))
        EXPECT_NEAR(volume, 0.5 - 0.25 * 0.5 * 0.5, 1e-14);
    const std::vector<Point> sites = randomSites(30);
    const std::vector<Polyhedron> cells = voronoiCells(sites, kUnitBox), convex = cellsOfConvex(sites, big);
    const std::vector<double> solid = volumesWithin(hollow, cells), whole = volumesWithin(big, cells);
    EXPECT_NEAR(std::accumulate(solid.begin(), solid.end(), 0.0), 1 - 0.125, 1e-13);
    for (size_t k = 0; k < sites.size(); ++k)
        EXPECT_NEAR(whole[k], volumeOf(convex[k]), 1e-14);
}

TEST(ClippedCells, DistanceIsToTheNearestPointOfATriangle) {
    const Triangle t = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    EXPECT_DOUBLE_EQ(distanceTo(t, {.25, .25, -2}), 2);
    EXPECT_DOUBLE_EQ(distanceTo(t, {-3, -4, 0}), 5);
    EXPECT_DOUBLE_EQ(distanceTo(t, {.5, -1, 0}), 1);
    EXPECT_DOUBLE_EQ(distanceTo(t, {1, 1, 0}), std::sqrt(.5));
}

} // namespace
