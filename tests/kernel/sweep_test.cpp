// Pairs that move fast: find_axes and build_manifolds against what anyone can work out, and against brute force in double.
#include "tests/kernel/random_pairs.h"
#include "tests/reference/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kernel_test {
namespace {

using reference::dot;
using reference::length;
using reference::Point;
using reference::operator+;
using reference::operator-;
using reference::operator*;

constexpr double kStep = 1.0 / 60;

gpu::Manifold meeting(const PlacedShape& wall, const PlacedShape& cube) {
    HullScene scene;
    scene.add(boxShape({.025, 2, 2}));
    scene.add(boxShape({.05, .05, .05}));
    scene.addPair(wall, cube);
    return manifoldsOf(scene)[0];
}

// At 300 m/s the cube goes five meters in a step: from anywhere before the wall to far behind it.
TEST(SmallSweep, ACubeDoesNotPassThroughAWall) {
    for (const double way : {.03, .5, 2.0, 4.9}) {
        const gpu::Manifold m = meeting({0}, {1, {.075 + way, .3, -.2}, kNoTurn, {-300, 0, 0}});
        ASSERT_EQ(m.info.x, 4u) << way;
        EXPECT_NEAR(m.normal.x, 1, 1e-6);
        for (const gpu::ContactPoint& p : m.points) {
            EXPECT_NEAR(p.arm_a.w, way, 1e-5);
            EXPECT_NEAR(p.arm_a.x, .025, 1e-5);
            EXPECT_NEAR(p.arm_b.x, -.05, 1e-5);
        }
    }
}

TEST(SmallSweep, OnlyWhatMeetsInThisStepTouches) {
    EXPECT_EQ(meeting({0}, {1, {5.2, 0, 0}, kNoTurn, {-300, 0, 0}}).info.x, 0u);   // ends before it
    EXPECT_EQ(meeting({0}, {1, {1, 0, 0}, kNoTurn, {300, 0, 0}}).info.x, 0u);      // leaves
    EXPECT_EQ(meeting({0}, {1, {1, 2.1, 0}, kNoTurn, {-300, 0, 0}}).info.x, 0u);   // passes beside it
    EXPECT_EQ(meeting({0}, {1, {1, 2.1, 0}, kNoTurn, {-300, -60, 0}}).info.x, 4u); // would pass beside it, but goes askew
    EXPECT_EQ(meeting({0}, {1, {1, 0, 0}, kNoTurn, {-30, 0, 0}}).info.x, 0u);      // is too slow
    EXPECT_EQ(meeting({0}, {1, {1, 0, 0}, kNoTurn, {0, 300, 0}}).info.x, 0u);      // goes along it
}

// What counts is how the two move against each other.
TEST(SmallSweep, BothMayMove) {
    const gpu::Manifold m = meeting({0, {0, 0, 0}, kNoTurn, {150, 40, 0}}, {1, {2.075, 0, 0}, kNoTurn, {-150, 40, 0}});
    ASSERT_EQ(m.info.x, 4u);
    EXPECT_NEAR(m.points[0].arm_a.w, 2, 1e-5);
    EXPECT_EQ(meeting({0, {0, 0, 0}, kNoTurn, {-300, 0, 0}}, {1, {2.075, 0, 0}, kNoTurn, {-300, 0, 0}}).info.x, 0u);
}

TEST(SmallSweep, HullsThatOverlapAlreadyAreNotSwept) {
    const gpu::Manifold m = meeting({0}, {1, {.07, 0, 0}, kNoTurn, {-300, 0, 0}});
    ASSERT_EQ(m.info.x, 4u);
    EXPECT_NEAR(m.normal.x, 1, 1e-6);
    EXPECT_NEAR(m.points[0].arm_a.w, -.005, 1e-6);
}

// A cube comes down on a floor of two boxes, over the first, and fast aslant towards the second. `rises`: by how much the
// second one is higher.
std::vector<gpu::Manifold> onTwoBoxes(bool hides, double rises) {
    HullScene scene;
    const uint32_t box = scene.add(boxShape({.5, .1, .5})), cube = scene.add(boxShape({.05, .05, .05}));
    PlacedShape first = {box, {0, -.1, 0}}, second = {box, {1, rises - .1, 0}};
    first.inverse_mass = second.inverse_mass = 0;
    scene.bodies = {first, second, {cube, {.1, .15, 0}, kNoTurn, {60, -30, 0}}};
    scene.pairs = {{0, 2}, {1, 2}};
    NarrowPhaseRun run;
    run.hides = hides;
    return manifoldsOf(scene, run);
}

TEST(SmallSweep, WhatIsHitFirstHidesTheSideOfAPieceBehindIt) {
    const std::vector<gpu::Manifold> seen = onTwoBoxes(false, 0), hidden = onTwoBoxes(true, 0);
    EXPECT_NEAR(seen[1].normal.x, -1, 1e-6) << "without the first box it would run into the side";
    EXPECT_EQ(hidden[1].info.x, 0u);
    EXPECT_NEAR(hidden[0].normal.y, 1, 1e-6);
    EXPECT_NEAR(hidden[0].points[0].arm_a.w, .1, 1e-5);
}

TEST(SmallSweep, AStepIsNotHidden) {
    const std::vector<gpu::Manifold> found = onTwoBoxes(true, .02);
    EXPECT_NEAR(found[0].normal.y, 1, 1e-6);
    EXPECT_NEAR(found[1].normal.x, -1, 1e-6);
}

// Edge over edge, 2 mm apart. Faces of both come towards each other's planes, and are gone before they meet.
gpu::Manifold passing(const Place& velocity, const Place& spin) {
    HullScene scene;
    scene.add(boxShape({.05, .05, .05}));
    const Turn on_edge = {0, 0, std::sin(std::numbers::pi / 8), std::cos(std::numbers::pi / 8)};
    PlacedShape flies = {0, {-.006, .1 * std::numbers::sqrt2 + .002, 0}, on_edge, velocity};
    flies.spin = spin;
    scene.addPair({0, {0, 0, 0}, on_edge}, flies);
    return manifoldsOf(scene)[0];
}

TEST(SmallSweep, WhatPassesNearAnEdgeDoesNotTouchIt) {
    EXPECT_GT(passing({0, 0, 0}, {0, 0, 0}).info.x, 0u) << "as near as contacts are looked for";
    EXPECT_EQ(passing({15, 0, 0}, {0, 0, 0}).info.x, 0u);
    EXPECT_GT(passing({15, -15, 0}, {0, 0, 0}).info.x, 0u) << "goes down and hits";
    EXPECT_GT(passing({15, 0, 0}, {0, 0, 3}).info.x, 0u) << "turns, and may hit";
}

// A solid about its first vertex, larger or smaller by a thousandth of its size on all sides.
reference::Convex resized(const reference::Convex& solid, double factor) {
    reference::Convex other = solid;
    Point middle = {0, 0, 0};
    for (const Point& p : solid.vertices)
        middle = middle + (1.0 / static_cast<double>(solid.vertices.size())) * p;
    for (Point& p : other.vertices)
        p = middle + factor * (p - middle);
    for (reference::ConvexFace& face : other.faces)
        face.height = dot(face.normal, other.vertices[face.loop[0]]);
    return other;
}

struct Tally {
    uint32_t hits = 0, misses = 0, missed = 0, ghosts = 0;
    double worst_late = 0, worst_early = 0; // ways left along the motion, as shares of the larger radius
};

void compare(Tally& tally, const HullScene& scene, uint32_t k, const gpu::Manifold& m) {
    const auto [a, b] = scene.pairs[k];
    const reference::Convex solid_a = scene.solidOf(a, a), solid_b = scene.solidOf(b, a);
    const gpu::vec4 v = scene.stateOf(b).velocity;
    const Point motion = kStep * Point{v.x, v.y, v.z};
    const double larger =
        std::max(radiusOf(scene.shapes[scene.bodies[a].shape]), radiusOf(scene.shapes[scene.bodies[b].shape]));
    if (reference::overlapOf(solid_a, solid_b) > -.02) return;
    const double time = reference::impactOf(solid_a, solid_b, motion);
    const bool hits = std::isfinite(time);
    ++(hits ? tally.hits : tally.misses);
    if (hits && m.info.x == 0) tally.missed += std::isfinite(reference::impactOf(solid_a, resized(solid_b, .998), motion));
    if (!hits && m.info.x > 0) tally.ghosts += !std::isfinite(reference::impactOf(solid_a, resized(solid_b, 1.002), motion));
    if (!hits || m.info.x == 0) return;
    double left = 1e300;
    for (uint32_t p = 0; p < m.info.x; ++p)
        left = std::min(left, static_cast<double>(m.points[p].arm_a.w));
    const double speed = -dot({m.normal.x, m.normal.y, m.normal.z}, motion);
    const double late = (left / speed - time) * length(motion) / larger;
    tally.worst_late = std::max(tally.worst_late, late);
    tally.worst_early = std::max(tally.worst_early, -late);
}

// Bodies that fly at where the other one is, more or less, and a few that fly away.
void setInMotion(HullScene& scene, std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> far(1.5, 6), beyond(.3, 2);
    for (const auto& [a, b] : scene.pairs) {
        const double size = radiusOf(scene.shapes[scene.bodies[a].shape]) + radiusOf(scene.shapes[scene.bodies[b].shape]);
        Place& place = scene.bodies[b].place;
        place = (far(random) * size / (length(place) + 1e-9)) * place;
        const Place aim = (.4 * size) * Place{normal(random), normal(random), normal(random)};
        scene.bodies[b].velocity = ((b % 14 == 1 ? -1 : 1) * beyond(random) / kStep) * (aim - place);
    }
}

void expectAgreement(uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    HullScene scene;
    addForms(scene, random, 80);
    addRandomPairs(scene, random, 80, count);
    setInMotion(scene, random);
    const auto manifolds = manifoldsOf(scene);
    Tally tally;
    for (uint32_t k = 0; k < count; ++k)
        compare(tally, scene, k, manifolds[k]);
    EXPECT_EQ(tally.missed, 0u);
    EXPECT_EQ(tally.ghosts, 0u);
    EXPECT_LT(tally.worst_late, 1e-3);
    EXPECT_LT(tally.worst_early, 1e-3);
    EXPECT_GT(tally.hits, count / 5);
    EXPECT_GT(tally.misses, count / 5);
    std::printf("%u hits, %u misses, at most %.2g late, %.2g early\n", tally.hits, tally.misses, tally.worst_late,
                tally.worst_early);
}

TEST(SweepOracle, ImpactsAreThoseOfBruteForce) { expectAgreement(1000, 1); }

TEST(LongSweep, ImpactsAreThoseOfBruteForceAHundredThousandTimes) {
    for (uint32_t seed = 0; seed < 10; ++seed)
        expectAgreement(10000, 200 + seed);
}

} // namespace
} // namespace kernel_test
