// find_axes and build_manifolds: the contacts of simple bodies, against what anyone can see, and of random ones against the
// separating axis theorem by brute force in double precision.
#include "tests/kernel/hull_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace kernel_test {
namespace {

using reference::dot;
using reference::length;
using reference::operator+;
using reference::operator-;
using reference::operator*;

constexpr double kRight = 1.5707963267948966;

Place placeOf(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

float deepestOf(const gpu::Manifold& m) {
    float deepest = 1e30f;
    for (uint32_t k = 0; k < m.info.x; ++k)
        deepest = std::min(deepest, m.points[k].arm_a.w);
    return deepest;
}

std::vector<uint32_t> namesOf(const gpu::Manifold& m) {
    std::vector<uint32_t> names;
    for (uint32_t k = 0; k < m.info.x; ++k)
        names.push_back(m.points[k].id.x);
    std::ranges::sort(names);
    return names;
}

std::vector<Word4> bytesOf(const std::vector<gpu::Manifold>& manifolds) {
    std::vector<Word4> words(manifolds.size() * sizeof(gpu::Manifold) / sizeof(Word4));
    std::memcpy(words.data(), manifolds.data(), words.size() * sizeof(Word4));
    return words;
}

void expectUp(const gpu::Manifold& m) {
    EXPECT_NEAR(m.normal.x, 0, 1e-5);
    EXPECT_NEAR(m.normal.y, 0, 1e-5);
    EXPECT_NEAR(m.normal.z, 1, 1e-5);
}

// A box of half a meter on a large one whose top is at z = 0, lifted so that its lowest point is at `gap`.
HullScene boxOnGround(const Turn& turn, double gap) {
    HullScene scene;
    const uint32_t ground = scene.add(boxShape({5, 5, 1})), box = scene.add(boxShape({.5, .5, .5}));
    double lowest = 0;
    for (const auto& v : scene.shapes[box].vertices)
        lowest = std::min(lowest, turned(turn, {v[0], v[1], v[2]})[2]);
    scene.addPair({ground, {0, 0, -1}}, {box, {.3, .2, gap - lowest}, turn});
    return scene;
}

TEST(SmallManifold, OfABoxOnAFaceHasFourPoints) {
    const gpu::Manifold m = manifoldsOf(boxOnGround(turnAbout({0, 0, 1}, .3), -.01))[0];
    ASSERT_EQ(m.info.x, 4u);
    expectUp(m);
    EXPECT_EQ(std::set<uint32_t>({m.points[0].id.x, m.points[1].id.x, m.points[2].id.x, m.points[3].id.x}).size(), 4u);
    for (const gpu::ContactPoint& p : m.points) {
        EXPECT_NEAR(p.arm_a.w, -.01, 1e-6);
        EXPECT_NEAR(p.arm_a.z, 1, 1e-6);
        EXPECT_NEAR(p.arm_b.z, -.5, 1e-6);
        EXPECT_NEAR(std::hypot(p.arm_b.x, p.arm_b.y), std::sqrt(.5), 1e-6);
    }
}

TEST(SmallManifold, OfABoxOnAnEdgeHasTwoPoints) {
    const gpu::Manifold m = manifoldsOf(boxOnGround(turnAbout({1, 0, 0}, kRight / 2), -.001))[0];
    ASSERT_EQ(m.info.x, 2u);
    expectUp(m);
    EXPECT_NEAR(m.points[0].arm_a.w, -.001, 1e-6);
    EXPECT_NEAR(m.points[1].arm_a.w, -.001, 1e-6);
    EXPECT_NEAR(std::abs(m.points[0].arm_b.x - m.points[1].arm_b.x), 1, 1e-5);
}

TEST(SmallManifold, OfABoxOnACornerHasOnePoint) {
    const Turn on_corner = after(turnAbout({1, 0, 0}, std::atan(std::sqrt(.5))), turnAbout({0, 1, 0}, kRight / 2));
    const gpu::Manifold m = manifoldsOf(boxOnGround(on_corner, -.001))[0];
    ASSERT_EQ(m.info.x, 1u);
    expectUp(m);
    EXPECT_NEAR(m.points[0].arm_a.w, -.001, 1e-6);
    EXPECT_NEAR(length(placeOf(m.points[0].arm_b)), std::sqrt(.75), 1e-5);
}

// Two bars across each other, edge over edge.
TEST(SmallManifold, OfCrossedEdgesHasOnePoint) {
    HullScene scene;
    const uint32_t bar = scene.add(boxShape({1, .1, .1}));
    const double reach = std::sqrt(.02);
    const Turn edge_up = turnAbout({1, 0, 0}, kRight / 2);
    scene.addPair({bar, {0, 0, 0}, edge_up}, {bar, {.2, .1, 2 * reach - .003}, after(turnAbout({0, 0, 1}, kRight), edge_up)});
    const gpu::Manifold m = manifoldsOf(scene)[0];
    ASSERT_EQ(m.info.x, 1u);
    expectUp(m);
    EXPECT_NEAR(m.points[0].arm_a.w, -.003, 1e-6);
    EXPECT_NEAR(m.points[0].arm_a.x, .2, 1e-5);
    EXPECT_NEAR(m.points[0].arm_a.y, 0, 1e-5);
    EXPECT_NEAR(m.points[0].arm_b.y, -.1, 1e-5);
}

TEST(SmallManifold, IsThereUpToTheSpeculativeDistance) {
    for (const double gap : {.0, .005, .019}) {
        const gpu::Manifold m = manifoldsOf(boxOnGround(kNoTurn, gap))[0];
        ASSERT_EQ(m.info.x, 4u) << gap;
        EXPECT_NEAR(deepestOf(m), gap, 1e-6);
    }
    EXPECT_EQ(manifoldsOf(boxOnGround(kNoTurn, .021))[0].info.x, 0u);
    // A tenth of the radius is less than two centimeters for a chip.
    HullScene chip;
    chip.add(boxShape({1, 1, 1}));
    chip.add(boxShape({.01, .01, .01}));
    chip.addPair({0}, {1, {0, 0, 1.01 + .001}});
    chip.addPair({0}, {1, {0, 0, 1.01 + .003}});
    const auto manifolds = manifoldsOf(chip);
    EXPECT_EQ(manifolds[0].info.x, 4u);
    EXPECT_EQ(manifolds[1].info.x, 0u);
}

// Of radius 1 and height 0.4; with 62 sides it has as many faces, vertices and edges as a hull may have.
Shape drumShape(uint32_t sides) {
    Shape drum;
    drum.loops.resize(2);
    for (uint32_t k = 0; k < sides; ++k) {
        const double angle = 4 * kRight * k / sides;
        for (const float z : {-.2f, .2f})
            drum.vertices.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z});
        const uint32_t next = (k + 1) % sides;
        drum.loops[1].push_back(2 * k + 1);
        drum.loops[0].insert(drum.loops[0].begin(), 2 * k);
        drum.loops.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
    }
    return drum;
}

// All pairs of 186 edges are looked at where the two fly at each other.
TEST(SmallManifold, OfTheLargestHullsIsWhole) {
    HullScene scene;
    const uint32_t drum = scene.add(drumShape(62));
    scene.addPair({drum}, {drum, {0, 0, .399}});
    scene.addPair({drum}, {drum, {4, 0, 0}, turnAbout({1, 0, 0}, kRight), {-300, 0, 0}});
    const auto manifolds = manifoldsOf(scene);
    ASSERT_EQ(manifolds[0].info.x, 4u);
    expectUp(manifolds[0]);
    EXPECT_NEAR(deepestOf(manifolds[0]), -.001, 1e-6);
    ASSERT_EQ(manifolds[1].info.x, 4u) << "where the narrow sides cross";
    EXPECT_NEAR(manifolds[1].normal.x, 1, 1e-5);
    EXPECT_NEAR(deepestOf(manifolds[1]), 2, 1e-5);
    for (const gpu::ContactPoint& point : manifolds[1].points)
        EXPECT_NEAR(point.arm_a.x, 1, 1 - std::cos(4 * kRight / 62) + 1e-5); // as far back as a side goes
}

// Points of more than four candidates lie as far apart as the face allows, and hold the deepest.
TEST(SmallManifold, OfARoundFaceKeepsTheDeepestAndSpreadsTheRest) {
    HullScene scene;
    const uint32_t ground = scene.add(boxShape({5, 5, 1})), wheel = scene.add(drumShape(20));
    scene.addPair({ground, {0, 0, -1}}, {wheel, {0, 0, .199}, turnAbout({0, 1, 0}, 1e-3)});
    const gpu::Manifold m = manifoldsOf(scene)[0];
    ASSERT_EQ(m.info.x, 4u);
    EXPECT_NEAR(deepestOf(m), -.002, 1e-5);
    Place low = {9, 9, 9}, high = {-9, -9, -9};
    for (const gpu::ContactPoint& p : m.points)
        for (size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], placeOf(p.arm_b)[k]);
            high[k] = std::max(high[k], placeOf(p.arm_b)[k]);
        }
    EXPECT_GT(high[0] - low[0], 1.8);
    EXPECT_GT(high[1] - low[1], 1.8);
}

// Below it has two triangles, which meet in its x axis and lean by 0.03 rad each. It is 4 times `size` wide.
Shape ridgedChip(float size) {
    const float low = -0.06f * size, edge = 2 * size;
    return {{{-edge, 0, low}, {edge, 0, low}, {0, edge, 0}, {0, -edge, 0}, {0, 0, size}},
            {{0, 1, 3}, {1, 0, 2}, {1, 2, 4}, {2, 0, 4}, {0, 3, 4}, {3, 1, 4}}};
}

// It touches the ground with its left triangle. m, m/s2.
gpu::Manifold ofChip(float size, double gravity) {
    HullScene scene;
    const uint32_t ground = scene.add(boxShape({5, 5, 1})), chip = scene.add(ridgedChip(size));
    const double lean = std::atan(0.03) + 1e-4;
    const Turn turn = turnAbout({1, 0, 0}, -lean);
    const double lowest = -0.06 * size * std::cos(lean);
    scene.addPair({ground, {0, 0, -1}}, {chip, {0, 0, -lowest}, turn});
    return manifoldsOf(scene, {.options = {.gravity = {0, 0, static_cast<float>(-gravity)}, .step = 1.0f / 60}})[0];
}

TEST(SmallManifold, OfAChipHoldsTheFaceThatItMayTipTo) {
    EXPECT_EQ(ofChip(1e-3f, 9.81).info.x, 4u);
    EXPECT_EQ(ofChip(1e-3f, 0).info.x, 3u);   // it does not tip
    EXPECT_EQ(ofChip(0.1f, 9.81).info.x, 3u); // it does not tip so far within a step
}

TEST(SmallManifold, KeepsItsNamesUnderSmallMotion) {
    HullScene scene;
    const uint32_t ground = scene.add(boxShape({5, 5, 1})), box = scene.add(boxShape({.5, .5, .5}));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shake(-1, 1);
    for (uint32_t k = 0; k < 200; ++k) {
        const Turn turn = turnAbout({shake(random), shake(random), shake(random)}, 1e-3 * shake(random));
        const Place by = {.01 * shake(random), .01 * shake(random), .499 + 1e-4 * shake(random)};
        scene.addPair({ground, {0, 0, -1}}, {box, by, turn});
        // On a box as large, edge on edge but for rounding.
        scene.addPair({box, {0, 0, -.5}}, {box, {1e-6 * shake(random), 1e-6 * shake(random), .499}});
    }
    const auto manifolds = manifoldsOf(scene);
    for (uint32_t k = 0; k < manifolds.size(); ++k) {
        EXPECT_EQ(manifolds[k].info.x, 4u) << k;
        EXPECT_EQ(namesOf(manifolds[k]), namesOf(manifolds[k % 2])) << k;
        EXPECT_EQ(manifolds[k].info.y, manifolds[k % 2].info.y) << k;
    }
}

TEST(SmallManifold, AHundredKilometersAwayIsTheSameBitForBit) {
    HullScene near, far;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> within(-1, 1);
    for (HullScene* scene : {&near, &far}) {
        random.seed(3);
        for (uint32_t k = 0; k < 8; ++k)
            scene->add(cellShape(random, 12, {1, 1, 1}));
        for (uint32_t k = 0; k < 40; ++k) {
            PlacedShape a = {
                k % 8, {7.5, within(random), within(random)}, turnAbout({1, within(random), .3}, 3 * within(random))};
            PlacedShape b = {
                (k + 3) % 8, {-7.5 + within(random), 0, 0}, turnAbout({.1, .5, within(random)}, 3 * within(random))};
            b.sector = {1, 0, 0};
            if (scene == &far)
                for (PlacedShape* body : {&a, &b})
                    body->sector = {body->sector[0] + 6250, -6250, 6250};
            scene->addPair(a, b);
        }
    }
    const auto here = manifoldsOf(near), there = manifoldsOf(far);
    EXPECT_EQ(bytesOf(here), bytesOf(there));
    EXPECT_GT(std::ranges::count_if(here, [](const gpu::Manifold& m) { return m.info.x > 0; }), 20);
}

// A triangle of a static mesh: no thickness, two faces back to back.
TEST(SmallManifold, OfATriangleIsThatOfAHull) {
    HullScene scene;
    const uint32_t triangle = scene.add(triangleShape({-2, -2, 0}, {3, -2, 0}, {-2, 3, 0})),
                   box = scene.add(boxShape({.5, .5, .5}));
    const Turn edge_down = turnAbout({1, 0, 0}, kRight / 2);
    scene.addPair({triangle}, {box, {-.5, -.5, .499}});
    scene.addPair({triangle}, {box, {-.5, -.5, -.499}});
    scene.addPair({triangle}, {box, {-.5, -.5, std::sqrt(.5) - .001}, edge_down});
    scene.addPair({triangle}, {box, {.5 + .5, .5 + .5, .2}}); // beyond the long side
    scene.addPair({triangle}, {box, {0, 0, .53}});
    // Its long side against an upright edge.
    scene.addPair({triangle}, {box, {.5 + .499, .5 + .499, 0}});
    const auto m = manifoldsOf(scene);
    EXPECT_EQ(m[0].info.x, 4u);
    EXPECT_NEAR(deepestOf(m[0]), -.001, 1e-6);
    EXPECT_NEAR(m[0].normal.z, 1, 1e-6);
    EXPECT_EQ(m[1].info.x, 4u);
    EXPECT_NEAR(m[1].normal.z, -1, 1e-6);
    EXPECT_EQ(m[2].info.x, 2u);
    EXPECT_EQ(m[3].info.x, 1u);
    EXPECT_EQ(m[4].info.x, 0u);
    EXPECT_EQ(m[5].info.x, 1u);
    EXPECT_NEAR(deepestOf(m[5]), -.002 / std::sqrt(2.0), 1e-5);
}

TEST(SmallManifold, OfHullsInOneAnotherSaysTheShortestWayOut) {
    HullScene scene;
    std::mt19937 random(5);
    const uint32_t box = scene.add(boxShape({.5, .4, .3})), small = scene.add(boxShape({.1, .1, .1})),
                   cell = scene.add(cellShape(random, 30, {1, 1, 1}));
    scene.addPair({box}, {box});
    scene.addPair({cell}, {cell});
    scene.addPair({box}, {small, {.1, .1, .05}});
    scene.addPair({small, {-.3, 0, 0}}, {cell});
    const auto manifolds = manifoldsOf(scene);
    for (uint32_t k = 0; k < manifolds.size(); ++k) {
        ASSERT_GT(manifolds[k].info.x, 0u) << k;
        const double overlap = reference::overlapOf(scene.solidOf(2 * k, 2 * k), scene.solidOf(2 * k + 1, 2 * k));
        EXPECT_NEAR(-deepestOf(manifolds[k]), overlap, 2e-5) << k;
    }
    EXPECT_NEAR(deepestOf(manifolds[0]), -.6, 1e-5);
    EXPECT_NEAR(deepestOf(manifolds[2]), -.35, 1e-5);
}

TEST(SmallManifold, OfNoPairsIsNone) {
    HullScene scene;
    scene.add(boxShape({1, 1, 1}));
    EXPECT_TRUE(manifoldsOf(scene).empty());
}

TEST(SmallNarrowPhase, RefusesOptionsThatMakeNoSense) {
    const engine::Buffer buffer = bufferOf(std::vector<uint32_t>(1024));
    const brittle::NarrowPhaseInput input = {{buffer, buffer, buffer, buffer, buffer}, buffer, buffer, buffer, buffer, 0, 4};
    const auto record = [&](const brittle::NarrowPhaseOptions& options, uint64_t bytes) {
        engine::Commands commands(engine_test::device());
        EXPECT_TRUE(commands.begin());
        const engine::BufferView room = engine::BufferView(buffer).sub(0, bytes);
        return brittle::recordNarrowPhase(commands, kernels(), input, options, {room, room, room}, false);
    };
    EXPECT_EQ(record({.speculative = -1}, 4096).error().code, engine::ErrorCode::BadInput);
    EXPECT_EQ(record({.duration = std::nanf("")}, 4096).error().code, engine::ErrorCode::BadInput);
    EXPECT_EQ(record({.fixed_axes = 7}, 4096).error().code, engine::ErrorCode::BadInput);
    EXPECT_EQ(record({}, 900).error().code, engine::ErrorCode::Capacity);
}

TEST(SmallNarrowPhase, RefusesACountThatLiesOutsideItsBuffer) {
    const engine::Buffer buffer = bufferOf(std::vector<uint32_t>(1024));
    brittle::NarrowPhaseInput input = {{buffer, buffer, buffer, buffer, buffer}, buffer, buffer, buffer, buffer, 1023, 4};
    const auto record = [&] {
        engine::Commands commands(engine_test::device());
        EXPECT_TRUE(commands.begin());
        return brittle::recordNarrowPhase(commands, kernels(), input, {}, {buffer, buffer, buffer}, false);
    };
    EXPECT_TRUE(record());
    input.count_at = 1024;
    EXPECT_EQ(record().error().code, engine::ErrorCode::Capacity);
    EXPECT_NE(record().error().message.find("counts has 4096 of 4100 bytes"), std::string::npos);
}

} // namespace
} // namespace kernel_test
