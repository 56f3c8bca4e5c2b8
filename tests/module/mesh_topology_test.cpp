#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace brittle;

namespace {

uint32_t start(const Mesh& mesh, uint32_t h) { return mesh.triangles[h / 3][h % 3]; }
uint32_t end(const Mesh& mesh, uint32_t h) { return mesh.triangles[h / 3][(h % 3 + 1) % 3]; }

void expectConsistent(const Mesh& mesh, const MeshTopology& topology) {
    EXPECT_TRUE(std::is_sorted(topology.edges.begin(), topology.edges.end()));
    EXPECT_EQ(std::adjacent_find(topology.edges.begin(), topology.edges.end()), topology.edges.end());
    for (uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
        const auto& [low, high] = topology.edges[topology.triangle_edges[h / 3][h % 3]];
        EXPECT_EQ(std::min(start(mesh, h), end(mesh, h)), low);
        EXPECT_EQ(std::max(start(mesh, h), end(mesh, h)), high);
        const uint32_t mate = topology.half_edge_mates[h];
        if (mate == kNoMate) continue;
        EXPECT_EQ(topology.half_edge_mates[mate], h);
        EXPECT_EQ(start(mesh, mate), end(mesh, h));
        EXPECT_EQ(end(mesh, mate), start(mesh, h));
    }
}

Mesh meshOf(std::vector<Float3> positions, std::vector<Index3> triangles) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

// Two tetrahedra, one above and one below the edge from vertex 0 to 1, that share nothing but it.
Mesh twoTetrahedraAtAnEdge() {
    return meshOf({{0, 0, 0}, {1, 0, 0}, {.5f, .5f, 1}, {.5f, -.5f, 1}, {.5f, .5f, -1}, {.5f, -.5f, -1}},
                  {{1, 0, 2}, {0, 1, 3}, {2, 0, 3}, {3, 1, 2}, {0, 1, 4}, {1, 0, 5}, {5, 0, 4}, {4, 1, 5}});
}

} // namespace

TEST(Topology, EveryHalfEdgeOfAClosedMeshHasItsMate) {
    for (const char* name : {"cube", "ring", "icosphere:3", "bumpy:4"}) {
        const auto model = prepareMesh(*makeBuiltin(name));
        ASSERT_TRUE(model);
        expectConsistent(model->mesh, model->topology);
        EXPECT_EQ(std::count(model->topology.half_edge_mates.begin(), model->topology.half_edge_mates.end(), kNoMate), 0);
        EXPECT_EQ(2 * model->topology.edges.size(), 3 * model->mesh.triangles.size());
    }
}

TEST(Topology, OpenAndTurnedEdgesHaveNoMate) {
    const Mesh one = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_EQ(buildTopology(one).half_edge_mates, std::vector<uint32_t>(3, kNoMate));
    const Mesh turned = meshOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}});
    EXPECT_EQ(buildTopology(turned).half_edge_mates, std::vector<uint32_t>(6, kNoMate));
    EXPECT_TRUE(buildTopology(Mesh{}).edges.empty());
}

TEST(Topology, SurfacesThatTouchAtAnEdgeStayApart) {
    const Mesh mesh = twoTetrahedraAtAnEdge();
    const MeshTopology topology = buildTopology(mesh);
    expectConsistent(mesh, topology);
    for (uint32_t h = 0; h < topology.half_edge_mates.size(); ++h)
        EXPECT_EQ(topology.half_edge_mates[h] / 3 < 4, h / 3 < 4) << h; // the first four triangles are the upper one
}

// A block with a notch whose tip just reaches the far side leaves four triangles at an edge, solid to the left and right.
TEST(Topology, PairsBoundSolidNotAir) {
    // Solid wedges at angles 0..60 and 120..300 degrees around the edge (0,0,0)-(0,0,1).
    const auto spoke = [](double degrees) {
        const double angle = degrees * 3.14159265358979 / 180;
        return Float3{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.5f};
    };
    // A triangle that runs up the edge has its solid at smaller angles.
    const Mesh mesh = meshOf({{0, 0, 0}, {0, 0, 1}, spoke(0), spoke(60), spoke(120), spoke(300)},
                             {{1, 0, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 5}});
    const MeshTopology topology = buildTopology(mesh);
    EXPECT_EQ(topology.half_edge_mates[0], 3u);
    EXPECT_EQ(topology.half_edge_mates[6], 9u);
}

TEST(Topology, IsQuickOnLargeMeshes) {
    const auto model = prepareMesh(makeBumpySphere(7)); // 327,680 triangles
    ASSERT_TRUE(model);
    const auto began = std::chrono::steady_clock::now();
    const MeshTopology topology = buildTopology(model->mesh);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    EXPECT_EQ(topology.edges.size(), 491'520u);
    EXPECT_LT(took.count(), 5); // 0.1 s on an idle core; generous, as sanitizers and other programs may be about
}
