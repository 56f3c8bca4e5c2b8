// separate_siblings: contacts of Voronoi cells that have just come apart, with their sites known, against those that are found
// by searching all axes.
#include "shaders-spirv/shared/effects.h"
#include "tests/kernel/hull_scene.h"
#include "tests/reference/voronoi.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace kernel_test {
namespace {

using reference::GridPoint;
using reference::operator+;
using reference::operator-;
using reference::operator*;

constexpr int32_t kEdge = 1 << 20;
constexpr double kMeters = 0.2 / kEdge;
constexpr uint32_t kStep = 41;

struct Cells {
    HullScene scene; // all pairs
    std::vector<gpu::Birth> births;
    std::vector<reference::VoronoiCell> cells;
};

Turn turnedBack(const Turn& q) { return {-q[0], -q[1], -q[2], q[3]}; }

Turn randomTurn(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return turnAbout({normal(random), normal(random), normal(random)}, 3 * normal(random));
}

Place middleOf(const reference::VoronoiCell& cell) {
    Place sum = {0, 0, 0};
    double count = 0;
    for (const reference::CellFace& face : cell.faces)
        for (const auto& corner : face.corners) {
            sum = sum + Place(corner);
            ++count;
        }
    return (1 / count) * sum;
}

// In axes of its own, about its middle. A corner is the same whichever face it is a corner of.
Shape shapeOf(const reference::VoronoiCell& cell, const Place& middle, const Turn& to_own) {
    Shape shape;
    std::map<std::array<uint32_t, 3>, uint32_t> numbers;
    for (const reference::CellFace& face : cell.faces) {
        shape.loops.emplace_back();
        for (size_t k = 0; k < face.corners.size(); ++k) {
            std::array<uint32_t, 3> name = {face.neighbor, face.sides[k], face.sides[(k + 1) % face.sides.size()]};
            std::ranges::sort(name);
            const auto [entry, is_new] = numbers.try_emplace(name, static_cast<uint32_t>(shape.vertices.size()));
            if (is_new) {
                const Place p = turned(to_own, kMeters * (Place(face.corners[k]) - middle));
                shape.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
            }
            shape.loops.back().push_back(entry->second);
        }
    }
    return shape;
}

// A cube in so many pieces, turned, each of which has axes of its own.
Cells brokenCube(uint32_t count, std::mt19937& random) {
    Cells made;
    reference::SiteSet set = {{{0, 0, 0}, {kEdge, kEdge, kEdge}}, {}};
    std::uniform_int_distribution<int32_t> along(0, kEdge);
    while (set.sites.size() < count)
        set.sites.push_back({along(random), along(random), along(random)});
    made.cells = reference::cutAllCells(set);
    const Turn of_all = randomTurn(random);
    for (uint32_t k = 0; k < count; ++k) {
        const Turn own = randomTurn(random);
        const Place middle = middleOf(made.cells[k]);
        const GridPoint& site = set.sites[k];
        const Place at = {double(site[0]), double(site[1]), double(site[2])};
        const uint32_t shape = made.scene.add(shapeOf(made.cells[k], middle, after(turnedBack(own), of_all)));
        made.scene.bodies.push_back({shape, turned(of_all, kMeters * (at + middle)), own});
        const Place s = turned(of_all, kMeters * at);
        made.births.push_back({{static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2]), 0},
                               made.scene.stateOf(k).turn,
                               {7, kStep, 0, 0}});
        for (uint32_t j = 0; j < k; ++j)
            made.scene.pairs.push_back({j, k});
    }
    return made;
}

// Kernels that look at what is known of siblings.
std::vector<gpu::Manifold> knownManifolds(const Cells& cube, const std::vector<gpu::Birth>& births, uint32_t steps) {
    engine::KernelLibrary library(engine_test::device(), shaders::all(), {{SIBLINGS_ID, 1}});
    NarrowPhaseRun run;
    run.kernels = &library;
    run.births = births;
    run.steps = steps;
    return manifoldsOf(cube.scene, run);
}

double deepestOf(const gpu::Manifold& m) {
    double deepest = 1e30;
    for (uint32_t k = 0; k < m.info.x; ++k)
        deepest = std::min(deepest, double{m.points[k].arm_a.w});
    return deepest;
}

bool areNeighbors(const Cells& cube, const std::array<uint32_t, 2>& pair) {
    return std::ranges::binary_search(cube.cells[pair[0]].neighbors, pair[1]);
}

// No two solids are further apart than their corners.
double nearestCorners(const HullScene& scene, const std::array<uint32_t, 2>& pair) {
    const reference::Convex a = scene.solidOf(pair[0], pair[0]), b = scene.solidOf(pair[1], pair[0]);
    double nearest = 1e30;
    for (const reference::Point& p : a.vertices)
        for (const reference::Point& q : b.vertices)
            nearest = std::min(nearest, reference::length(p - q));
    return nearest;
}

// What a search finds to touch, touches, and what is known to be apart is no further apart than it is. In a face neighbors
// touch where a search finds them touching; with an edge or a corner in common they are kept on their sides of the plane.
void expectAlike(const Cells& cube, size_t pair, const gpu::Manifold& known, const gpu::Manifold& found) {
    EXPECT_GE(known.info.x > 0, found.info.x > 0) << pair;
    if (known.info.x == 0) {
        EXPECT_LE(known.normal.w, nearestCorners(cube.scene, cube.scene.pairs[pair]) + 1e-6);
        return;
    }
    if (!areNeighbors(cube, cube.scene.pairs[pair]) || found.info.x < 3 || known.info.x < 3) return;
    EXPECT_NEAR(deepestOf(known), deepestOf(found), 2e-6);
    const double cosine = known.normal.x * found.normal.x + known.normal.y * found.normal.y + known.normal.z * found.normal.z;
    EXPECT_GT(cosine, 1 - 1e-4) << pair;
}

void expectAllAlike(const Cells& cube, const std::vector<gpu::Manifold>& told, const std::vector<gpu::Manifold>& found) {
    for (size_t k = 0; k < found.size(); ++k)
        expectAlike(cube, k, told[k], found[k]);
}

size_t touchingIn(const std::vector<gpu::Manifold>& manifolds) {
    return static_cast<size_t>(std::ranges::count_if(manifolds, [](const gpu::Manifold& m) { return m.info.x > 0; }));
}

TEST(SmallSiblings, TouchAsASearchFindsThemTouching) {
    std::mt19937 random(11);
    for (const uint32_t count : {2u, 9u, 40u}) {
        const Cells cube = brokenCube(count, random);
        const auto found = manifoldsOf(cube.scene);
        const auto told = knownManifolds(cube, cube.births, kStep), later = knownManifolds(cube, cube.births, kStep + 1);
        expectAllAlike(cube, told, found);
        expectAllAlike(cube, later, found);
        EXPECT_GE(touchingIn(told), count - 1);
        EXPECT_EQ(touchingIn(told), touchingIn(found));
        EXPECT_EQ(touchingIn(later), touchingIn(found));
    }
}

// They have gone on, turned together, and come apart a little: the plane turns with them.
TEST(SmallSiblings, ThatHaveTurnedTogetherAreStillParted) {
    std::mt19937 random(14);
    Cells cube = brokenCube(40, random);
    const Turn turn = turnAbout({1, 2, 3}, 0.7);
    for (PlacedShape& body : cube.scene.bodies) {
        body.place = turned(turn, 1.02 * body.place);
        body.turn = after(turn, body.turn);
    }
    expectAllAlike(cube, knownManifolds(cube, cube.births, kStep + 5), manifoldsOf(cube.scene));
}

TEST(SmallSiblings, OfDifferentBodiesAreSearchedAsAnyPair) {
    std::mt19937 random(12);
    const Cells cube = brokenCube(12, random);
    const auto found = manifoldsOf(cube.scene);
    std::vector<gpu::Birth> births = cube.births;
    for (uint32_t k = 0; k < births.size(); ++k)
        births[k].of.x = k;
    const auto searched = knownManifolds(cube, births, kStep);
    EXPECT_EQ(std::memcmp(searched.data(), found.data(), found.size() * sizeof(gpu::Manifold)), 0);
}

// Between two that fly at each other the plane halfway keeps nobody from meeting.
TEST(SmallSiblings, ThatMeetInTheStepAreSearched) {
    std::mt19937 random(13);
    Cells cube = brokenCube(40, random);
    for (PlacedShape& body : cube.scene.bodies)
        body.velocity = (-5.0) * (body.place - Place{0.1, 0.1, 0.1});
    const auto found = manifoldsOf(cube.scene), told = knownManifolds(cube, cube.births, kStep);
    for (size_t k = 0; k < found.size(); ++k)
        EXPECT_GE(told[k].info.x > 0, found[k].info.x > 0) << k;
}

} // namespace
} // namespace kernel_test
