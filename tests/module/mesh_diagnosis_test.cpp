// What the doctor says, against models whose ailments are known.
#include "modules/brittle/mesh/diagnosis.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/support/shared_meshes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace brittle;
using namespace support;

namespace {

MeshDiagnosis diagnose(const ImportedMesh& imported) {
    const auto model = prepareMesh(imported);
    if (!model) throw std::runtime_error(model.error().message);
    return diagnoseMesh(model->mesh, model->topology);
}

} // namespace

TEST(Diagnosis, NamesThePartsAndTheirGenus) {
    const MeshDiagnosis found = diagnose(makeTwistedRing() + moved(makeIcosphere(1), 0.1, {9, 0, 0}));
    ASSERT_EQ(found.parts.size(), 2u);
    EXPECT_EQ(found.parts[0].genus, 1u);
    EXPECT_EQ(found.parts[1].genus, 0u);
    EXPECT_EQ(found.parts[1].triangles, 80u);
    EXPECT_EQ(found.parts[1].vertices, 42u);
    EXPECT_EQ(found.parts[1].edges, 120u);
    EXPECT_NEAR(found.parts[1].where[0], 9, 0.2);
    EXPECT_TRUE(found.holes.empty());
}

TEST(Diagnosis, MeasuresHoles) {
    ImportedMesh cube = moved(makeCube(), 2, {10, 20, 30});
    std::erase_if(cube.triangles, [&](const Index3& t) {
        return cube.positions[t[0]][0] > 10 && cube.positions[t[1]][0] > 10 && cube.positions[t[2]][0] > 10;
    });
    const MeshDiagnosis found = diagnose(cube);
    ASSERT_EQ(found.holes.size(), 1u);
    EXPECT_EQ(found.holes[0].edges, 4u);
    EXPECT_DOUBLE_EQ(found.holes[0].length, 8);
    EXPECT_DOUBLE_EQ(found.holes[0].diameter, std::sqrt(8.0));
    EXPECT_EQ(found.holes[0].where, (Double3{11, 20, 30}));
    EXPECT_TRUE(found.holes[0].is_simple);
    EXPECT_EQ(found.parts[0].rims, 1u);
    EXPECT_EQ(found.parts[0].genus, 0u);
}

TEST(Diagnosis, SaysWhereSurfacesTouchTurnOverAndDouble) {
    const MeshDiagnosis edge = diagnose(makeCube() + moved(makeCube(), 1, {1, 1, 0}));
    EXPECT_EQ(edge.nonmanifold_edges, (std::vector<Double3>{{0.5, 0.5, 0}}));
    EXPECT_EQ(edge.nonmanifold_vertices.size(), 2u);
    EXPECT_EQ(diagnose(makeCube() + moved(makeCube(), 1, {1, 1, 1})).nonmanifold_vertices,
              (std::vector<Double3>{{0.5, 0.5, 0.5}}));
    ImportedMesh turned = makeCube();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_EQ(diagnose(turned).inconsistent_edges.size(), 3u);
    EXPECT_EQ(diagnose(makeCube() + turnedOver(makeCube())).duplicates.size(), 12u);
}

TEST(Diagnosis, ListsSliversAndCrossingsTheWorstFirst) {
    ImportedMesh plate = makeCube();
    for (Double3& p : plate.positions)
        p[2] *= p[0] < 0 ? 1e-3 : 2e-3;
    const MeshDiagnosis thin = diagnose(plate);
    ASSERT_GE(thin.slivers.size(), 2u);
    EXPECT_TRUE(std::is_sorted(thin.slivers.begin(), thin.slivers.end(),
                               [](const auto& a, const auto& b) { return a.aspect > b.aspect; }));
    EXPECT_GT(thin.slivers.front().aspect, 900);
    const MeshDiagnosis crossing = diagnose(makeCube() + moved(makeCube(), 0.5, {0.5, 0.1, 0.05}));
    ASSERT_FALSE(crossing.crossings.empty());
    EXPECT_EQ(crossing.crossings.size(), crossing.report.self_intersection.crossing_pairs);
    EXPECT_EQ(crossing.crossings.front().depth, crossing.report.self_intersection.deepest.depth);
    EXPECT_NEAR(crossing.crossings.front().where[0], 0.4, 0.3);
}

// The catalogue's figures were counted by other programs.
TEST(Diagnosis, AgreesWithTheCatalogue) {
    SKIP_WITHOUT_MESHES();
    struct Expected {
        const char* name;
        size_t parts, rims, nonmanifold_edges, nonmanifold_vertices, slivers;
        int genus; // of the first part; -1: none
    };
    static constexpr Expected kModels[] = {
        {"elephant-with-holes.off", 1, 106, 0, 65, 0, 3},
        {"cheese.off", 1, 0, 0, 0, 62, 133},
        {"gearwheel.bin.stl", 1, 0, 0, 0, 440, 1},
        {"utah_teapot.stl", 1, 0, 0, 0, 46, 1},
        {"1002_tray_bottom.STL", 1, 0, 0, 0, 438, 23},
        {"couplingdown.off", 1, 0, 0, 0, 0, 9},
        {"moebius.obj", 1, 1, 0, 0, 0, -1},
        {"spider.fbx", 18, 6, 0, 0, 0, 0},
        {"terrain.ply", 1, 1, 0, 0, 0, 0},
        {"abdomen.dae", 1, 0, 0, 0, 182, 0},
        {"bad/torus-double-sided.obj", 1, 0, 6912, 2304, 0, 1},
        {"bad/spot-t-junctions.obj", 1, 60, 0, 0, 0, 0},
    };
    for (const Expected& expected : kModels) {
        SCOPED_TRACE(expected.name);
        const MeshDiagnosis found = diagnose(*importMesh(sharedMesh(expected.name)));
        EXPECT_EQ(found.parts.size(), expected.parts);
        EXPECT_EQ(std::accumulate(found.parts.begin(), found.parts.end(), size_t{0},
                                  [](size_t sum, const auto& part) { return sum + part.rims; }),
                  expected.rims);
        EXPECT_EQ(found.nonmanifold_edges.size(), expected.nonmanifold_edges);
        EXPECT_EQ(found.nonmanifold_vertices.size(), expected.nonmanifold_vertices);
        EXPECT_EQ(found.slivers.size(), expected.slivers);
        EXPECT_EQ(found.parts[0].genus ? static_cast<int>(*found.parts[0].genus) : -1, expected.genus);
        size_t edges = 0;
        for (const MeshDiagnosis::Hole& hole : found.holes)
            edges += hole.edges;
        EXPECT_EQ(edges, found.report.open_edges);
    }
}

// An arrowhead that is cut into triangles from its notch, and from a tip.
TEST(Diagnosis, NamesEdgesAtWhichAFaceLiesOnItsNeighbor) {
    EXPECT_TRUE(diagnose(fanPrism({{1, 0}, {3, 1}, {0, 0}, {3, -1}}, 1)).folds.empty());
    const MeshDiagnosis found = diagnose(fanPrism({{3, -1}, {1, 0}, {3, 1}, {0, 0}}, 1));
    EXPECT_TRUE(found.report.isSound());
    EXPECT_EQ(found.folds, (std::vector<Double3>{{3, 0, 0}, {3, 0, 1}}));
    EXPECT_TRUE(diagnose(makeBumpySphere(4)).folds.empty());
}
