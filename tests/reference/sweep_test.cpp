// impactOf against boxes whose impact anyone can work out.
#include "tests/reference/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reference {
namespace {

Convex boxAt(const Point& at, double half) {
    Convex box;
    for (uint32_t k = 0; k < 8; ++k)
        box.vertices.push_back(at + Point{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half});
    const std::vector<std::vector<uint32_t>> loops = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    const std::vector<Point> normals = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    for (size_t f = 0; f < 6; ++f)
        box.faces.push_back({normals[f], dot(normals[f], at) + half, loops[f]});
    return box;
}

TEST(Sweep, OfBoxesIsTheShareOfTheWayToTheWall) {
    const Convex wall = boxAt({0, 0, 0}, 1);
    EXPECT_NEAR(impactOf(wall, boxAt({5, 0, 0}, 1), {-6, 0, 0}), .5, 1e-12);
    EXPECT_NEAR(impactOf(wall, boxAt({5, 5, 0}, 1), {-4, -4, 0}), .75, 1e-12);
    EXPECT_EQ(impactOf(wall, boxAt({1.5, 0, 0}, 1), {-6, 0, 0}), 0);
    EXPECT_TRUE(std::isinf(impactOf(wall, boxAt({5, 0, 0}, 1), {-2, 0, 0})));
    EXPECT_TRUE(std::isinf(impactOf(wall, boxAt({5, 0, 0}, 1), {6, 0, 0})));
    EXPECT_TRUE(std::isinf(impactOf(wall, boxAt({5, 2.5, 0}, 1), {-9, 0, 0})));
    EXPECT_TRUE(std::isinf(impactOf(wall, boxAt({5, 0, 0}, 1), {0, 0, 0})));
}

} // namespace
} // namespace reference
