// Hulls of points: the brute-force hull, closed, weighed right, never with more faces than a body may have; and no hull where
// the points span no solid.
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/scene/hull/convex_hull.h"
#include "modules/brittle/scene/hull/support_tree.h"
#include "tests/reference/hull.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace brittle;

namespace {

using Points = std::vector<Double3>;
using reference::operator+;
using reference::operator-;
using reference::operator*;

class Dice {
public:
    explicit Dice(uint64_t seed) : engine_(seed) {}
    double between(double a, double b) { return a + (b - a) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
    Double3 inCube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
    Double3 onSphere() {
        for (;;) {
            const Double3 p = inCube();
            const double size = std::sqrt(reference::dot(p, p));
            if (size < 1 && size > 0.1) return {p[0] / size, p[1] / size, p[2] / size};
        }
    }

private:
    std::mt19937_64 engine_;
};

reference::Convex asReference(const ConvexHull& hull) {
    reference::Convex solid;
    solid.vertices = hull.vertices;
    for (const ConvexHull::Face& face : hull.faces) {
        const auto first = hull.corners.begin() + face.first_corner;
        solid.faces.push_back({face.normal, face.height, {first, first + face.corner_count}});
    }
    return solid;
}

double sizeOf(const Points& points) {
    reference::Bounds bounds;
    for (const Double3& p : points)
        bounds.grow(p);
    return bounds.diagonal();
}

void expectEdges(const ConvexHull& hull) {
    const auto walks = [&](uint32_t f, uint32_t from, uint32_t to) {
        const ConvexHull::Face& face = hull.faces[f];
        for (uint32_t k = 0; k < face.corner_count; ++k)
            if (hull.corners[face.first_corner + k] == from &&
                hull.corners[face.first_corner + (k + 1) % face.corner_count] == to)
                return true;
        return false;
    };
    ASSERT_EQ(2 * hull.edges.size(), hull.corners.size());
    for (const ConvexHull::Edge& edge : hull.edges) {
        EXPECT_LT(edge.from, edge.to);
        EXPECT_TRUE(walks(edge.left, edge.from, edge.to));
        EXPECT_TRUE(walks(edge.right, edge.to, edge.from));
    }
}

void expectWeight(const HullMeasures& measures, const reference::Weight& weight, double size) {
    EXPECT_NEAR(measures.volume, weight.volume, 1e-9 * weight.volume);
    EXPECT_LT(reference::length(measures.center - weight.center), 1e-9 * size);
    for (size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(measures.inertia[k], weight.inertia[k], 1e-9 * weight.volume * size * size) << k;
}

// Closed, convex, holds all points, has edges and weight.
PointHull expectHull(const Points& points) {
    const auto made = hullOfPoints(points);
    EXPECT_TRUE(made) << made.error().message;
    if (!made) return {};
    const double size = sizeOf(points);
    const reference::Convex solid = asReference(made->hull);
    EXPECT_EQ(reference::defectOf(solid, kFaceDepth * kHullTolerance * size), "");
    for (const Double3& p : points)
        EXPECT_LE(reference::distanceOutside(solid, p), kFaceDepth * kHullTolerance * size);
    EXPECT_LE(made->hull.faces.size(), kMaxHullFaces);
    EXPECT_LE(made->hull.vertices.size(), kMaxHullVertices);
    expectEdges(made->hull);
    if (made->notes.loosened == 0) expectWeight(made->measures, reference::weightOf(solid), size);
    return *made;
}

Points boxPoints(const Double3& size) {
    Points points;
    for (int v = 0; v < 8; ++v)
        points.push_back({v & 1 ? size[0] : 0, v & 2 ? size[1] : 0, v & 4 ? size[2] : 0});
    return points;
}

// The k-th of a cube of `side` points a side, one meter apart.
Double3 latticePoint(int k, int side) {
    const int column = k % side, row = k / side % side, layer = k / (side * side);
    return {double(column), double(row), double(layer)};
}

Points spherePoints(Dice& dice, int count) {
    Points points;
    for (int k = 0; k < count; ++k)
        points.push_back(dice.onSphere());
    return points;
}

void expectRefused(const Points& points, const std::string& reason) {
    const auto made = hullOfPoints(points);
    ASSERT_FALSE(made) << reason;
    EXPECT_EQ(made.error().code, engine::ErrorCode::BadInput);
    EXPECT_TRUE(made.error().message.starts_with(reason)) << made.error().message;
    EXPECT_EQ(made.error().message.find('\n'), std::string::npos);
}

TEST(SmallSceneHull, OfABoxHasSixFacesAndItsWeight) {
    const PointHull box = expectHull(boxPoints({2, 3, 5}));
    EXPECT_EQ(box.hull.faces.size(), 6u);
    EXPECT_EQ(box.hull.vertices.size(), 8u);
    EXPECT_EQ(box.hull.edges.size(), 12u);
    EXPECT_NEAR(box.measures.volume, 30, 1e-12);
    EXPECT_NEAR(box.measures.center[2], 2.5, 1e-12);
    EXPECT_NEAR(box.measures.inertia[0], 30 * (9 + 25) / 12.0, 1e-10);
    EXPECT_NEAR(box.measures.inertia[2], 30 * (4 + 9) / 12.0, 1e-10);
    EXPECT_NEAR(box.measures.inertia[4], 0, 1e-10);
}

TEST(SmallSceneHull, IsTheBruteForceHull) {
    Dice dice(1);
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(round);
        Points points;
        const int count = 4 + round % 17;
        for (int k = 0; k < count; ++k)
            points.push_back(dice.inCube());
        const PointHull made = expectHull(points);
        const reference::Convex brute = reference::hullByBruteForce(points, 1e-9);
        EXPECT_EQ(made.hull.faces.size(), brute.faces.size());
        expectWeight(made.measures, reference::weightOf(brute), 4);
    }
}

TEST(SmallSceneHull, OfALatticeHasFlatFaces) {
    Points points;
    for (int k = 0; k < 5 * 5 * 5; ++k)
        points.push_back(latticePoint(k, 5));
    const PointHull cube = expectHull(points);
    EXPECT_EQ(cube.hull.faces.size(), 6u);
    EXPECT_EQ(cube.hull.vertices.size(), 8u);
    EXPECT_NEAR(cube.measures.volume, 64, 1e-12);
}

// A turned lattice whose coordinates went through floats, anywhere: what was flat is flat.
TEST(SmallSceneHull, JoinsWhatIsFlatButForTheRoundingOfFloats) {
    Dice dice(2);
    for (int round = 0; round < 40; ++round) {
        SCOPED_TRACE(round);
        const Double3 x = dice.onSphere(), other = dice.onSphere();
        Double3 y = reference::cross(x, other);
        y = (1 / reference::length(y)) * y;
        const Double3 z = reference::cross(x, y);
        const double scale = std::pow(10.0, round % 9 - 4);
        Points points;
        for (int k = 0; k < 27; ++k) {
            Double3 p = scale * (latticePoint(k, 3)[0] * x + latticePoint(k, 3)[1] * y + latticePoint(k, 3)[2] * z);
            for (double& c : p)
                c = static_cast<double>(static_cast<float>(c));
            points.push_back(p);
        }
        const PointHull cube = expectHull(points);
        EXPECT_EQ(cube.hull.faces.size(), 6u);
        EXPECT_EQ(cube.hull.vertices.size(), 8u);
    }
}

TEST(SmallSceneHull, DoesNotDependOnScaleOrPlace) {
    Dice dice(3);
    const Points points = spherePoints(dice, 20);
    const size_t faces = expectHull(points).hull.faces.size();
    for (const double scale : {1e-5, 1.0, 1e5}) {
        Points moved = points;
        for (Double3& p : moved)
            p = scale * (p + Double3{1000, -2000, 500});
        EXPECT_EQ(expectHull(moved).hull.faces.size(), faces);
    }
}

TEST(SmallSceneHull, IsTheSameEveryTime) {
    Dice dice(4);
    const Points points = spherePoints(dice, 30);
    const auto first = hullOfPoints(points), again = hullOfPoints(points);
    ASSERT_TRUE(first && again);
    EXPECT_EQ(first->hull.vertices, again->hull.vertices);
    EXPECT_EQ(first->hull.corners, again->hull.corners);
    EXPECT_EQ(first->measures.inertia, again->measures.inertia);
}

TEST(SmallSceneHull, RefusesPointsThatSpanNoSolid) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    expectRefused({}, "too few points");
    expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "too few points");
    expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}}, "not finite");
    expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, inf}}, "not finite");
    expectRefused({{0, 0, 0}, {1e200, 0, 0}, {0, 1, 0}, {0, 0, 1}}, "too large");
    expectRefused(Points(9, {1, 2, 3}), "coincident points");
    expectRefused({{1e9, 0, 0}, {1e9 + 1e-7, 0, 0}, {1e9, 1e-7, 0}, {1e9, 0, 1e-7}}, "coincident points");
    expectRefused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}, {3, 3, 3}}, "collinear points");
    expectRefused({{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}, {3, 2, 5}}, "coplanar points");
    expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1e-9, 0}}, "too few points");
    expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-7}}, "coplanar points");
}

TEST(SmallSceneHull, JoinsDoubledPointsAndCountsThem) {
    Points points = boxPoints({1, 1, 1});
    for (int k = 0; k < 8; ++k)
        points.push_back(points[static_cast<size_t>(k)] + Double3{k % 2 == 0 ? 5e-7 : -3e-7, 2e-7, 0});
    const PointHull box = expectHull(points);
    EXPECT_EQ(box.notes.joined, 8u);
    EXPECT_EQ(box.hull.vertices.size(), 8u);
    EXPECT_EQ(box.hull.faces.size(), 6u);
}

TEST(SmallSceneHull, TakesThinPlatesAndSlivers) {
    expectHull(boxPoints({1, 1, 1e-3}));
    expectHull(boxPoints({1, 1e-4, 1e-4}));
    expectHull({{-.5, 0, -.3}, {.5, 0, -.3}, {0, 0, .5}, {.1, 1e-3, -.1}});
}

TEST(SmallSceneHull, OfTooManyFacesIsLooserButHoldsThePoints) {
    Dice dice(5);
    for (const int count : {60, 200, 3000}) {
        SCOPED_TRACE(count);
        const Points points = spherePoints(dice, count);
        const PointHull ball = expectHull(points);
        EXPECT_GT(ball.notes.faces_in, kMaxHullFaces);
        EXPECT_GT(ball.notes.loosened, 0);
        EXPECT_LT(ball.notes.loosened, 0.2);
        const reference::Weight held = reference::weightOf(asReference(ball.hull));
        EXPECT_GT(held.volume, ball.measures.volume);
        EXPECT_LT(held.volume, 1.3 * 4 * M_PI / 3);
    }
}

// Looking at every corner for every face would take a minute.
TEST(SmallSceneHull, OfAHundredThousandPointsOnASphereIsMadeWithoutLookingAtThemAllForEveryFace) {
    Dice dice(9);
    const PointHull ball = expectHull(spherePoints(dice, 100'000));
    EXPECT_GT(ball.notes.faces_in, 100'000u);
    EXPECT_NEAR(ball.measures.volume, 4 * M_PI / 3, 1e-3);
}

double furthestAlong(const Double3& direction, const Points& points) {
    double most = -1e300;
    for (const Double3& p : points)
        most = std::max(most, reference::dot(direction, p));
    return most;
}

TEST(SmallSceneHull, ReachesAsFarAsTheFurthestPointToTheBit) {
    EXPECT_EQ(SupportTree({}).support({1, 0, 0}), -1e300);
    Dice dice(10);
    for (const int count : {1, 2, 16, 17, 33, 1000}) {
        Points points = spherePoints(dice, count);
        points.insert(points.end(), {points[0], {0, 0, 0}, 3 * dice.inCube()});
        const SupportTree tree(points);
        for (int k = 0; k < 100; ++k) {
            const Double3 d = k < 3 ? Double3{double(k == 0), double(k == 1), -double(k == 2)} : dice.onSphere();
            EXPECT_EQ(tree.support(d), furthestAlong(d, points)) << count;
        }
    }
}

TEST(SmallSceneHull, OfThirtyFourPointsOnASphereFitsAsItIs) {
    Dice dice(6);
    const PointHull ball = expectHull(spherePoints(dice, 34));
    EXPECT_EQ(ball.hull.vertices.size(), 34u);
    EXPECT_EQ(ball.hull.faces.size(), 64u);
    EXPECT_EQ(ball.notes.loosened, 0);
}

// Prisms, cones, lattices and balls, with jitter from none to a thousandth: around the tolerance planes and points are neither
// one nor two.
Points jittered(Dice& dice, int round) {
    const int sides = 3 + round % 29;
    const double jitter = round % 13 == 0 ? 0 : std::pow(10.0, dice.between(-9, -3));
    Points points;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * M_PI * k / sides;
        const Double3 rim = {std::cos(angle), std::sin(angle), 0};
        switch (round % 4) {
        case 0: points.insert(points.end(), {rim + Double3{0, 0, 1}, rim - Double3{0, 0, 1}}); break;
        case 1: points.insert(points.end(), {rim, Double3{0, 0, 1}}); break;
        case 2: points.push_back(latticePoint(k, 3)); break;
        default: points.push_back(dice.onSphere());
        }
    }
    if (round % 4 == 3 || sides < 10) points.insert(points.end(), {{0, 0, 2}, {0, 0, -2}, {2, 0, 0}, {0, 2, 0}});
    for (Double3& p : points)
        p = p + jitter * dice.inCube();
    return points;
}

TEST(SceneHull, StandsJitterOfAnySize) {
    Dice dice(7);
    for (int round = 0; round < 2000; ++round) {
        SCOPED_TRACE(round);
        expectHull(jittered(dice, round));
        if (testing::Test::HasFailure()) return;
    }
}

TEST(LongSceneHull, StandsJitterOfAnySize) {
    Dice dice(8);
    for (int round = 0; round < 20'000; ++round) {
        SCOPED_TRACE(round);
        expectHull(jittered(dice, round));
        if (testing::Test::HasFailure()) return;
    }
}

TEST(SceneHull, HoldsWholeModels) {
    SKIP_WITHOUT_MESHES();
    for (const char* name : {"goblet-Vase.stl", "armadillo.obj", "utah_teapot.stl", "fandisk.off", "torus.obj"}) {
        SCOPED_TRACE(name);
        const auto model = importMesh(support::sharedMesh(name));
        ASSERT_TRUE(model) << model.error().message;
        const PointHull hull = expectHull(model->positions);
        EXPECT_LT(hull.notes.loosened, 0.05 * sizeOf(model->positions));
    }
}

} // namespace
