#include "modules/brittle/mesh/imported_mesh.h"
#include "modules/brittle/mesh/polygon.h"
#include "modules/brittle/mesh/vector_math.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace brittle;

namespace {

double areaOf(const std::vector<Double3>& outline, const Index3& t) {
    return cross(outline[t[1]] - outline[t[0]], outline[t[2]] - outline[t[0]])[2] / 2;
}

// Every triangle turns the right way, and together they have the outline's area.
void expectTriangulation(const std::vector<Double3>& outline, double area) {
    const std::vector<Index3> triangles = triangulatePolygon(outline);
    ASSERT_EQ(triangles.size(), outline.size() - 2);
    double sum = 0;
    for (const Index3& t : triangles) {
        EXPECT_GE(areaOf(outline, t), 0);
        sum += areaOf(outline, t);
    }
    EXPECT_NEAR(sum, area, 1e-12 * area);
}

std::vector<Double3> star(uint32_t points, double inner) {
    std::vector<Double3> outline;
    for (uint32_t k = 0; k < 2 * points; ++k) {
        const double angle = std::numbers::pi * k / points, radius = k % 2 == 0 ? 1 : inner;
        outline.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    return outline;
}

} // namespace

TEST(Polygon, ConvexOutlineGivesTheFanFromItsFirstCorner) {
    const std::vector<Double3> pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 2, 0}, {1, 3, 0}, {-1, 1, 0}};
    const std::vector<Index3> expected = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    EXPECT_EQ(triangulatePolygon(pentagon), expected);
}

TEST(Polygon, ConcaveOutlines) {
    expectTriangulation({{1, 2, 0}, {0, 1, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}}, 2.75);
    for (const double inner : {0.9, 0.5, 0.1, 0.001})
        for (const uint32_t points : {3u, 5u, 50u})
            expectTriangulation(star(points, inner), points * inner * std::sin(std::numbers::pi / points));
}

TEST(Polygon, CornersOnAStraightLine) {
    expectTriangulation({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, 4);
}

TEST(Polygon, HoleReachedByABridge) {
    // A square of side 3 with a square hole of side 1, joined by an edge that is walked both ways.
    expectTriangulation(
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}}, 8);
}

TEST(Polygon, WindsAsTheOutlineDoesWhateverItsPlane) {
    const std::vector<Double3> flat = star(7, 0.4);
    for (const Double3& axis : {Double3{1, 0, 0}, Double3{0, -1, 0}, Double3{0.3, -0.5, -0.8}}) {
        const Double3 n = normalized(axis, axis), u = normalized(cross(n, {0.1, 0.2, 0.9}), n), v = cross(n, u);
        std::vector<Double3> outline = flat;
        for (Double3& p : outline)
            p = p[0] * u + p[1] * v;
        double along = 0;
        for (const Index3& t : triangulatePolygon(outline))
            along += dot(n, cross(outline[t[1]] - outline[t[0]], outline[t[2]] - outline[t[0]])) / 2;
        EXPECT_NEAR(along, 7 * 0.4 * std::sin(std::numbers::pi / 7), 1e-12);
    }
}

TEST(Polygon, OutlineThatCrossesItselfIsRefused) {
    EXPECT_TRUE(triangulatePolygon(std::vector<Double3>{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, -3, 0}, {0, 4, 0}}).empty());
    MeshBuilder mesh;
    std::vector<PolygonCorner> corners;
    for (const Double3& p : {Double3{0, 0, 0}, Double3{4, 0, 0}, Double3{4, 4, 0}, Double3{1, -3, 0}, Double3{0, 4, 0}}) {
        corners.push_back({static_cast<uint32_t>(mesh.vertexCount()), {0, 0, 0}, {0, 0}});
        mesh.addVertex(p);
    }
    EXPECT_NE(mesh.addPolygon(corners), nullptr);
}

TEST(Polygon, RepeatedCornersAreSkipped) {
    MeshBuilder mesh;
    for (const Double3& p : {Double3{0, 0, 0}, Double3{1, 0, 0}, Double3{0, 1, 0}})
        mesh.addVertex(p);
    const auto corner = [](uint32_t v) { return PolygonCorner{v, {0, 0, 0}, {0, 0}}; };
    EXPECT_EQ(mesh.addPolygon(std::vector{corner(0), corner(0), corner(1), corner(2), corner(0)}), nullptr);
    EXPECT_EQ(mesh.triangleCount(), 1u);
    EXPECT_EQ(mesh.addPolygon(std::vector{corner(0), corner(1), corner(0)}), nullptr);
    EXPECT_EQ(mesh.triangleCount(), 1u);
}
