// Hulls drawn in, on solids whose inner ones are known by heart.
#include "tests/support/inset_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using reference::Convex, reference::Point;

constexpr double kSigns[] = {-1, 1};

// Half its edge is 1.
Convex cube() {
    Convex solid;
    for (const double x : kSigns)
        for (const double y : kSigns)
            for (const double z : kSigns)
                solid.vertices.push_back({x, y, z});
    for (size_t axis = 0; axis < 3; ++axis)
        for (const double sign : kSigns) {
            Point normal = {0, 0, 0};
            normal[axis] = sign;
            solid.faces.push_back({normal, 1, {}});
        }
    return solid;
}

// Four faces meet in each of its corners, which are 1 from its center.
Convex octahedron() {
    Convex solid;
    for (size_t axis = 0; axis < 3; ++axis)
        for (const double sign : kSigns) {
            Point corner = {0, 0, 0};
            corner[axis] = sign;
            solid.vertices.push_back(corner);
        }
    const double share = 1 / std::sqrt(3);
    for (const double x : kSigns)
        for (const double y : kSigns)
            for (const double z : kSigns)
                solid.faces.push_back({{x * share, y * share, z * share}, share, {}});
    return solid;
}

void expectCubeOfHalf(double half, const std::vector<Point>& corners) {
    EXPECT_EQ(corners.size(), 8u);
    for (const Point& p : corners)
        for (const double x : p)
            EXPECT_NEAR(std::fabs(x), half, 1e-12);
}

TEST(InsetHull, FacesOfACubeMoveInwardByTheDepth) {
    expectCubeOfHalf(1, support::insetCorners(cube(), 0));
    expectCubeOfHalf(0.9, support::insetCorners(cube(), 0.1));
}

TEST(InsetHull, HasOneCornerWhereManyFacesMeet) {
    const std::vector<Point> corners = support::insetCorners(octahedron(), 0.1);
    EXPECT_EQ(corners.size(), 6u);
    for (const Point& p : corners)
        EXPECT_NEAR(std::fabs(p[0]) + std::fabs(p[1]) + std::fabs(p[2]), 1 - 0.1 * std::sqrt(3), 1e-12);
}

TEST(InsetHull, AFaceThatIsTooSmallGoes) {
    const double share = 1 / std::sqrt(3);
    Convex solid = cube();
    solid.faces.push_back({{share, share, share}, std::sqrt(3) - 0.05, {}});
    EXPECT_EQ(support::insetCorners(solid, 0).size(), 10u);
    expectCubeOfHalf(0.9, support::insetCorners(solid, 0.1));
}

TEST(InsetHull, NothingIsLeftOfWhatIsThinner) { EXPECT_TRUE(support::insetCorners(cube(), 1.1).empty()); }

} // namespace
