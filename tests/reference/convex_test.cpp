// The checker of convex solids finds what it should find.
#include "tests/reference/convex.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using reference::Convex;
using reference::Point;
using reference::operator-; // of arrays, which argument-dependent lookup does not find
using reference::operator*;

// The unit cube from `lower`; corner k has its upper x, y, z where bits 0, 1, 2 of k are set.
Convex cubeAt(const Point& lower) {
    Convex cube;
    for (uint32_t k = 0; k < 8; ++k)
        cube.vertices.push_back({lower[0] + (k & 1), lower[1] + (k >> 1 & 1), lower[2] + (k >> 2 & 1)});
    cube.faces = {{{-1, 0, 0}, -lower[0], {0, 4, 6, 2}}, {{1, 0, 0}, lower[0] + 1, {1, 3, 7, 5}},
                  {{0, -1, 0}, -lower[1], {0, 1, 5, 4}}, {{0, 1, 0}, lower[1] + 1, {2, 6, 7, 3}},
                  {{0, 0, -1}, -lower[2], {0, 2, 3, 1}}, {{0, 0, 1}, lower[2] + 1, {4, 5, 7, 6}}};
    return cube;
}

TEST(Convex, ACubeHasNoDefect) {
    const Convex cube = cubeAt({3, -2, .5});
    EXPECT_EQ(reference::defectOf(cube, 1e-12), "");
    EXPECT_NEAR(reference::volumeOf(cube), 1, 1e-12);
    EXPECT_EQ(reference::distanceOutside(cube, {3.5, -1.5, 1}), 0);
    EXPECT_NEAR(reference::distanceOutside(cube, {3.5, -3, 1}), 1, 1e-12);
}

TEST(Convex, DefectsAreFound) {
    Convex open = cubeAt({0, 0, 0}), turned = open, dented = open, tilted = open, loose = open, lowered = open;
    open.faces.pop_back();
    std::ranges::reverse(turned.faces[1].loop);
    dented.vertices[7] = {.6, .6, .6};
    tilted.faces[0].normal = {-.8, .6, 0};
    loose.vertices.push_back({.5, .5, .5});
    lowered.faces[5].height = .9;
    for (const Convex* solid : {&open, &turned, &dented, &tilted, &loose, &lowered})
        EXPECT_NE(reference::defectOf(*solid, 1e-3), "");
}

TEST(Convex, OverlapIsTheDepthAlongTheBestAxis) {
    const Convex cube = cubeAt({0, 0, 0});
    EXPECT_NEAR(reference::overlapOf(cube, cubeAt({.75, .5, .25})), .25, 1e-12);
    EXPECT_NEAR(reference::overlapOf(cube, cubeAt({1, 0, 0})), 0, 1e-12);
    EXPECT_LT(reference::overlapOf(cube, cubeAt({.5, 1.5, 0})), -.4);
}

// Two tetrahedra whose boxes and faces overlap, and which only the cross product of two edges parts.
TEST(Convex, SolidsThatMeetEdgeToEdgeAreParted) {
    const auto tetrahedron = [](const std::array<Point, 4>& corners) {
        Convex solid{{corners.begin(), corners.end()}, {}};
        for (const std::vector<uint32_t>& loop : {std::vector<uint32_t>{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}) {
            const Point& a = corners[loop[0]];
            const Point n = reference::cross(corners[loop[1]] - a, corners[loop[2]] - a);
            const Point normal = (1 / reference::length(n)) * n;
            solid.faces.push_back({normal, reference::dot(normal, a), loop});
        }
        return solid;
    };
    const Convex below = tetrahedron({Point{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}});
    const Convex above = tetrahedron({Point{0, 1, .01}, {0, -1, .01}, {-1, 0, 1}, {1, 0, 1}});
    ASSERT_EQ(reference::defectOf(below, 1e-9), "");
    ASSERT_EQ(reference::defectOf(above, 1e-9), "");
    EXPECT_NEAR(reference::overlapOf(below, above), -.01, 1e-9);
}

} // namespace
