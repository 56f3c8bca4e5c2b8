#include "tests/reference/geometry.h"

#include "tests/support/shapes.h"

#include <gtest/gtest.h>

namespace reference {
namespace {

TEST(ReferenceGeometry, MeasuresOfABox) {
    const Triangles box = support::boxTriangles({1, 2, 3}, {3, 5, 7});
    EXPECT_NEAR(volumeOf(box), 24, 1e-12);
    EXPECT_NEAR(areaOf(box), 2 * (2 * 3 + 3 * 4 + 4 * 2), 1e-12);
    const Point centroid = centroidOf(box);
    EXPECT_NEAR(centroid[0], 2, 1e-12);
    EXPECT_NEAR(centroid[1], 3.5, 1e-12);
    EXPECT_NEAR(centroid[2], 5, 1e-12);
}

TEST(ReferenceGeometry, MeasuresSurviveDistance) {
    EXPECT_NEAR(volumeOf(support::boxTriangles({1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1})), 1, 1e-9);
}

TEST(ReferenceGeometry, TurnedOverBoxHasNegativeVolume) {
    EXPECT_NEAR(volumeOf(support::turnedOver(support::boxTriangles({0, 0, 0}, {1, 1, 1}))), -1, 1e-12);
}

TEST(ReferenceGeometry, WindingNumberCountsLayers) {
    const Triangles outer = support::boxTriangles({0, 0, 0}, {4, 4, 4});
    const Triangles hollow = support::joined(outer, support::turnedOver(support::boxTriangles({1, 1, 1}, {3, 3, 3})));
    EXPECT_NEAR(double(windingNumber(outer, {2, 2, 2})), 1, 1e-9);
    EXPECT_NEAR(double(windingNumber(outer, {5, 2, 2})), 0, 1e-9);
    EXPECT_NEAR(double(windingNumber(hollow, {2, 2, 2})), 0, 1e-9);
    EXPECT_NEAR(double(windingNumber(hollow, {.5, 2, 2})), 1, 1e-9);
    EXPECT_NEAR(double(windingNumber(support::joined(outer, outer), {2, 2, 2})), 2, 1e-9);
}

TEST(ReferenceGeometry, NearestSiteGivesTiesToTheLowerId) {
    const std::vector<GridPoint> sites = {{0, 0, 0}, {10, 0, 0}, {10, 0, 1 << 23}};
    EXPECT_EQ(nearestSite(sites, GridPoint{5, 0, 0}), 0u);
    EXPECT_EQ(nearestSite(sites, GridPoint{6, 0, 0}), 1u);
    EXPECT_EQ(nearestSite(sites, GridPoint{6, 0, 1 << 22}), 1u);
    EXPECT_EQ(nearestSite(sites, GridPoint{6, 0, (1 << 22) + 1}), 2u);
    const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(nearestSite(points, Point{.5, 3, 0}), 0u);
    EXPECT_EQ(nearestSite(points, Point{.51, 3, 0}), 1u);
}

TEST(ReferenceGeometry, DistanceOutsideACell) {
    const std::vector<Point> sites = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    EXPECT_EQ(distanceOutsideCell(sites, 0, {.9, .9, 5}), 0);
    EXPECT_NEAR(distanceOutsideCell(sites, 0, {1.25, .9, 5}), .25, 1e-12);
    EXPECT_NEAR(distanceOutsideCell(sites, 1, {0, 0, 0}), 1, 1e-12);
}

} // namespace
} // namespace reference
