#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

using namespace brittle;
using namespace support;

namespace {

// The unit cube with the other diagonal in every face.
ImportedMesh otherCube() {
    ImportedMesh cube = makeCube();
    for (size_t t = 0; t < cube.triangles.size(); t += 2) {
        Index3 &a = cube.triangles[t], &b = cube.triangles[t + 1]; // (p, q, r) and (p, r, s)
        const uint32_t p = a[0], q = a[1], r = a[2], s = b[2];
        a = {p, q, s};
        b = {q, r, s};
    }
    return cube;
}

// Without that triangle: a dent instead, down to the middle of the face opposite or beside it. Of a face beside it a part lies
// on the dent then.
ImportedMesh dentedCube(size_t triangle, const Double3& to) {
    ImportedMesh cube = makeCube();
    const Index3 t = cube.triangles[triangle];
    const auto deepest = static_cast<uint32_t>(cube.positions.size());
    cube.positions.push_back(to);
    cube.triangles[triangle] = {t[0], t[1], deepest};
    cube.triangles.push_back({t[1], t[2], deepest});
    cube.triangles.push_back({t[2], t[0], deepest});
    cube.corner_normals.assign(3 * cube.triangles.size(), {0, 0, 0});
    cube.corner_uvs.assign(3 * cube.triangles.size(), {0, 0});
    return cube;
}

MeshReport inspect(const ImportedMesh& imported) {
    const auto model = prepareMesh(imported);
    if (!model) throw std::runtime_error(model.error().message);
    MeshReport report = inspectMesh(model->mesh, model->topology);
    EXPECT_EQ(report.isSound(), checkMesh(model->mesh, model->topology).has_value());
    return report;
}

bool mentions(const MeshReport& report, const std::string& words) {
    return std::any_of(report.problems.begin(), report.problems.end(),
                       [&](const std::string& problem) { return problem.find(words) != problem.npos; });
}

Corners triangleAt(const Double3& a, const Double3& b, const Double3& c) { return {a, b, c}; }

} // namespace

TEST(Check, SoundModels) {
    for (const char* name : {"ring", "cube", "icosphere:3", "bumpy:4"}) {
        const MeshReport report = inspect(*makeBuiltin(name));
        EXPECT_TRUE(report.isSound()) << name << ": " << (report.problems.empty() ? "" : report.problems.front());
        EXPECT_EQ(report.components, 1u);
        EXPECT_EQ(report.self_intersection.crossing_pairs + report.self_intersection.touching_pairs, 0u);
    }
}

TEST(Check, SaysWhereASurfaceIsOpen) {
    ImportedMesh cube = moved(makeCube(), 2, {10, 20, 30});
    cube.triangles.pop_back();
    const MeshReport report = inspect(cube);
    EXPECT_EQ(report.open_edges, 3u);
    EXPECT_TRUE(mentions(report, "3 open edges, first at (9, 20, 31)")) << report.problems.front();
}

TEST(Check, SaysWhereASurfaceTurnsOver) {
    ImportedMesh cube = makeCube();
    std::swap(cube.triangles[0][0], cube.triangles[0][1]);
    EXPECT_EQ(inspect(cube).inconsistent_edges, 3u);
}

TEST(Check, TrianglesThatDoNotPairUp) {
    ImportedMesh cube = makeCube();
    cube.positions.push_back({2, 2, 2});
    cube = cube + ImportedMesh{{}, {{0, 1, 8}}, {}, {}};
    cube.triangles.back() = {0, 1, 8};
    const MeshReport report = inspect(cube);
    EXPECT_EQ(report.nonmanifold_edges, 1u);
    EXPECT_EQ(report.open_edges, 2u);
}

TEST(Check, SolidsMayTouch) {
    for (const Double3& by :
         {Double3{1, 0, 0}, Double3{1, 1, 0}, Double3{1, 1, 1}, Double3{1, 0.5, 0.25}}) { // face, edge, corner, part
        const MeshReport report = inspect(makeCube() + moved(makeCube(), 1, by));
        EXPECT_TRUE(report.isSound()) << report.problems.front();
        EXPECT_EQ(report.components, 2u);
        EXPECT_NEAR(report.measures.volume, 2, 1e-6);
    }
    EXPECT_EQ(inspect(makeCube() + moved(makeCube(), 1, {1, 1, 0})).shared_edges, 1u);
}

// What lies between two layers without a distance has no side: it is judged by the rest.
TEST(Check, ASurfaceMayLieOnItself) {
    int layered = 0;
    for (size_t triangle = 0; triangle < 12; ++triangle)
        for (size_t axis = 0; axis < 3; ++axis)
            for (const double side : {-0.5, 0.5}) {
                Double3 to = {0, 0, 0};
                to[axis] = side;
                const ImportedMesh cube = dentedCube(triangle, to);
                const auto [a, b, c] = makeCube().triangles[triangle];
                const auto on = [&](uint32_t v) { return cube.positions[v][axis] == side; };
                if (on(a) && on(b) && on(c)) continue; // no dent
                layered += on(a) + on(b) + on(c) == 2 ? 1 : 0;
                const MeshReport report = inspect(cube);
                EXPECT_TRUE(report.isSound()) << triangle << ", " << axis << ", " << side << ": " << report.problems.front();
            }
    EXPECT_EQ(layered, 24);
}

TEST(Check, SolidsMayNotCross) {
    const MeshReport report = inspect(makeCube() + moved(makeIcosphere(2), 0.5, {0.5, 0.1, 0.2}));
    EXPECT_GT(report.self_intersection.crossing_pairs, 0u);
    EXPECT_TRUE(mentions(report, "cross"));
}

TEST(Check, SolidsMayNotStandInEachOther) {
    EXPECT_EQ(inspect(makeCube() + moved(makeIcosphere(2), 0.2, {0.1, 0.1, 0.1})).misplaced_components, 1u);
    EXPECT_FALSE(inspect(makeCube() + otherCube()).isSound()); // all faces coincide, no two triangles do
    EXPECT_FALSE(inspect(makeCube() + makeCube()).isSound());
    // A wall of a hollow where there is no solid around it.
    EXPECT_EQ(inspect(makeCube() + turnedOver(moved(makeIcosphere(2), 0.2, {3, 0, 0}))).misplaced_components, 1u);
}

TEST(Check, CavitiesAndWhatLiesInThem) {
    const ImportedMesh hollow = makeIcosphere(3) + turnedOver(moved(makeIcosphere(3), 0.98, {0, 0, 0}));
    const MeshReport report = inspect(hollow);
    EXPECT_TRUE(report.isSound());
    EXPECT_EQ(report.components, 2u);
    EXPECT_EQ(report.cavities, 1u);
    EXPECT_TRUE(inspect(hollow + moved(makeCube(), 0.5, {0, 0, 0})).isSound());
}

TEST(Check, ManyCavities) {
    ImportedMesh cheese = moved(makeCube(), 10, {0, 0, 0});
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                cheese = cheese + turnedOver(moved(makeIcosphere(1), 0.4, {1.5 * x, 1.5 * y, 1.5 * z}));
    const MeshReport report = inspect(cheese);
    EXPECT_TRUE(report.isSound());
    EXPECT_EQ(report.cavities, 125u);
}

TEST(Check, FlatAndDoubledModels) {
    ImportedMesh flat = makeIcosphere(3);
    for (Double3& p : flat.positions)
        p[2] = 0;
    EXPECT_FALSE(inspect(flat).isSound());
    const ImportedMesh sheet = makeCube();
    EXPECT_EQ(inspect(sheet + sheet).duplicate_triangles, 12u);
    EXPECT_EQ(inspect(sheet + turnedOver(sheet)).duplicate_triangles, 12u); // its faces have two sides
}

TEST(Check, EmptyMesh) { EXPECT_FALSE(checkMesh(Mesh{}, MeshTopology{})); }

TEST(Penetration, OfTrianglesThatAreKnown) {
    const Corners floor = triangleAt({-4, -4, 0}, {4, -4, 0}, {0, 8, 0});
    // A blade through the middle, its tip `depth` below.
    for (const double depth : {1.0, 1e-3, 1e-8})
        EXPECT_NEAR(penetrationDepth(floor, triangleAt({0, 0, -depth}, {1, 1, 2}, {-1, 1, 2})), depth, 1e-12);
    EXPECT_EQ(penetrationDepth(floor, triangleAt({0, 0, 0}, {1, 1, 2}, {-1, 1, 2})), 0);    // a corner on it
    EXPECT_EQ(penetrationDepth(floor, triangleAt({0, 0, 1e-9}, {1, 1, 2}, {-1, 1, 2})), 0); // above it
    EXPECT_EQ(penetrationDepth(floor, triangleAt({-1, 0, 0}, {1, 0, 0}, {0, 1, 0})), 0);    // in its plane
    EXPECT_EQ(penetrationDepth(floor, triangleAt({9, 0, -1}, {9, 1, 1}, {9, -1, 1})), 0);   // beside it
    EXPECT_EQ(penetrationDepth(floor, triangleAt({0, 0, -1}, {0, 0, 1}, {0, 0, 3})), 1);    // a triangle that is only a line
    EXPECT_EQ(penetrationDepth(triangleAt({-1, 0, 0}, {1, 0, 0}, {2, 0, 0}), triangleAt({0, 0, -1}, {0, 0, 1}, {0, 0, 3})),
              0);                                                                            // two
    EXPECT_EQ(penetrationDepth(floor, triangleAt({-4, -4, 0}, {4, -4, 0}, {0, 0, 5})), 0);   // across an edge
    EXPECT_EQ(penetrationDepth(floor, triangleAt({-4, -4, 0}, {-9, 0, 1}, {-9, 0, -1})), 0); // at a corner, pointing away
    EXPECT_GT(penetrationDepth(floor, triangleAt({-4, -4, 0}, {3, 1, 1}, {3, 1, -1})), 0.1); // at a corner, through it
}

TEST(Penetration, DoesNotDependOnOrderOrPlace) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        Corners a, b;
        for (Double3* p : {&a[0], &a[1], &a[2], &b[0], &b[1], &b[2]})
            *p = {unit(random), unit(random), unit(random)};
        const double depth = penetrationDepth(a, b);
        EXPECT_NEAR(penetrationDepth(b, a), depth, 1e-12);
        EXPECT_NEAR(penetrationDepth({a[1], a[2], a[0]}, {b[2], b[1], b[0]}), depth, 1e-12);
        const Double3 by = {3, -7, 5};
        EXPECT_NEAR(penetrationDepth({a[0] + by, a[1] + by, a[2] + by}, {b[0] + by, b[1] + by, b[2] + by}), depth, 1e-12);
        if (depth == 0) continue;
        // Crossing means that an edge of one passes through the other.
        const auto pierces = [](const Double3& p, const Double3& q, const Corners& t) {
            const auto side = [](const Double3& o, const Double3& u, const Double3& v, const Double3& w) {
                return dot(u - o, cross(v - o, w - o));
            };
            const double s = side(p, q, t[0], t[1]), u = side(p, q, t[1], t[2]), v = side(p, q, t[2], t[0]);
            const bool same = (s > 0) == (u > 0) && (u > 0) == (v > 0);
            return same && (side(t[0], t[1], t[2], p) > 0) != (side(t[0], t[1], t[2], q) > 0);
        };
        bool crosses = false;
        for (size_t e = 0; e < 3; ++e)
            crosses = crosses || pierces(a[e], a[(e + 1) % 3], b) || pierces(b[e], b[(e + 1) % 3], a);
        EXPECT_TRUE(crosses);
    }
}

// Every model of the collection as its catalogue says; crossings counted there by exact arithmetic.
TEST(Check, SharedModels) {
    SKIP_WITHOUT_MESHES();
    struct Expected {
        const char* name;
        bool sound;
        uint32_t components, open_edges, crossings;
    };
    static constexpr Expected kModels[] = {
        {"ico4.obj", true, 1, 0, 0},
        {"spot_low_resolution.obj", true, 1, 0, 0},
        {"utah_teapot.stl", true, 1, 0, 0},
        {"bunny_hr.obj", true, 1, 0, 0},
        {"fandisk.off", true, 1, 0, 0},
        {"gearwheel.bin.stl", true, 1, 0, 0},
        {"torus.obj", true, 1, 0, 0},
        {"trefoil.obj", true, 1, 0, 0},
        {"cheese.off", true, 1, 0, 0},
        {"couplingdown.off", true, 1, 0, 0},
        {"goblet-Vase.stl", true, 1, 0, 0},
        {"hundred_cubes.obj", true, 100, 0, 0},
        {"armadillo.obj", true, 1, 0, 0},
        {"thingi10k-908460.stl", true, 1, 0, 0},
        {"thingi10k-99865.stl", true, 4, 0, 0},
        {"1002_tray_bottom.STL", true, 1, 0, 0},
        {"nefertiti-lowres.obj", true, 1, 0, 0},
        {"sword.obj", true, 1, 0, 0},
        {"ellipe0.003.off", true, 1, 0, 0},
        {"capsule.obj", true, 1, 0, 0},
        {"bones.off", false, 26, 0, 366},
        {"moebius.obj", false, 1, 112, 0},
        {"elephant-with-holes.off", false, 1, 1353, 0},
        {"terrain.ply", false, 1, 412, 0},
    };
    for (const Expected& expected : kModels) {
        const auto imported = importMesh(support::sharedMesh(expected.name));
        ASSERT_TRUE(imported) << imported.error().message;
        const MeshReport report = inspect(*imported);
        EXPECT_EQ(report.isSound(), expected.sound) << expected.name;
        EXPECT_EQ(report.components, expected.components) << expected.name;
        EXPECT_EQ(report.open_edges, expected.open_edges) << expected.name;
        EXPECT_EQ(report.self_intersection.crossing_pairs, expected.crossings) << expected.name;
    }
}

// The teapot's slivers cross by 7e-9 of its diagonal, where truly crossing parts do so by 2e-3 and more: what lies between is
// the room for telling rounding from faults.
TEST(Check, RoundingIsToldFromCrossing) {
    SKIP_WITHOUT_MESHES();
    const auto relative_depth = [](const char* name) {
        const MeshReport report = inspect(*importMesh(support::sharedMesh(name)));
        return report.self_intersection.deepest.depth / report.measures.diagonal;
    };
    EXPECT_LT(relative_depth("utah_teapot.stl"), 0.02 * kTouchDepth);
    for (const char* crossing : {"bones.off", "self_intersectA.obj", "openscad-nonmanifold-crash.obj"})
        EXPECT_GT(relative_depth(crossing), 1000 * kTouchDepth) << crossing;
}

TEST(Check, LargeModelsTakeSeconds) {
    SKIP_WITHOUT_MESHES();
    const auto imported = importMesh(support::sharedMesh("turbineblade.ply"));
    ASSERT_TRUE(imported);
    const auto began = std::chrono::steady_clock::now();
    EXPECT_TRUE(inspect(*imported).isSound());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    EXPECT_LT(took.count(), 20); // 0.5 s on an idle core, 199,034 triangles; inspected twice, perhaps under sanitizers
}
