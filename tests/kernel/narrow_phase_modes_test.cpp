// What the narrow phase does not depend on, and its fixed axes.
#include "tests/kernel/random_pairs.h"

#include <algorithm>
#include <limits>

namespace kernel_test {
namespace {

using reference::operator*;

std::vector<uint32_t> wordsOf(const std::vector<gpu::Manifold>& manifolds) {
    std::vector<uint32_t> words(manifolds.size() * sizeof(gpu::Manifold) / 4);
    std::memcpy(words.data(), manifolds.data(), words.size() * 4);
    return words;
}

// Near pairs of which some fly at each other.
HullScene manyPairs(uint32_t count) {
    std::mt19937 random(11);
    HullScene scene;
    addForms(scene, random, 40);
    addRandomPairs(scene, random, 40, count);
    for (uint32_t k = 0; k < count; k += 3) {
        auto& body = scene.bodies[2 * k + 1];
        body.velocity = -90.0 * body.place;
    }
    return scene;
}

TEST(NarrowPhase, GivesTheSameBytesWhateverTheLanes) {
    const HullScene scene = manyPairs(300);
    const auto expected = wordsOf(manifoldsOf(scene));
    EXPECT_EQ(wordsOf(manifoldsOf(scene)), expected);
    EXPECT_EQ(wordsOf(manifoldsOf(scene, {.many_lanes = true})), expected);
    for (const uint32_t lanes : {8u, 256u}) {
        engine::KernelLibrary library(engine_test::device(), shaders::all(), {{FLAT_SIZE_ID, lanes}});
        EXPECT_EQ(wordsOf(manifoldsOf(scene, {.kernels = &library})), expected) << lanes;
    }
}

TEST(SmallNarrowPhase, TakesAsManyPairsAsThereAre) {
    for (const uint32_t count : kSizes) {
        HullScene scene;
        const uint32_t box = scene.add(boxShape({.5, .5, .5}));
        for (uint32_t k = 0; k < count; ++k)
            scene.addPair({box}, {box, {0, 0, k % 3 == 0 ? 1.5 : .99}});
        const auto manifolds = manifoldsOf(scene);
        for (uint32_t k = 0; k < count; ++k) {
            EXPECT_EQ(manifolds[k].info.x, k % 3 == 0 ? 0u : 4u) << k << " of " << count;
            EXPECT_EQ(manifolds[k].pair.x, 2 * k);
            EXPECT_EQ(manifolds[k].pair.w, 2 * k + 1);
        }
    }
}

// More workgroups than fit in a row of the grid.
TEST(NarrowPhase, TakesMorePairsThanARowOfWorkgroups) {
    HullScene scene;
    const uint32_t box = scene.add(boxShape({.5, .5, .5}));
    scene.addPair({box}, {box, {0, 0, .99}});
    scene.addPair({box}, {box, {0, 0, 1.5}});
    scene.pairs.resize(70001, {0, 1});
    scene.pairs[65535] = scene.pairs[70000] = {2, 3};
    const auto manifolds = manifoldsOf(scene);
    for (uint32_t k = 0; k < manifolds.size(); ++k)
        ASSERT_EQ(manifolds[k].info.x, k == 1 || k == 65535 || k == 70000 ? 0u : 4u) << k;
}

// Along fewer axes hulls seem to overlap that do not, and never the other way round; boxes along the axes are exact.
TEST(SmallFixedAxes, NeverTakeHullsThatOverlapForApart) {
    const HullScene scene = manyPairs(200);
    const auto exact = manifoldsOf(scene, {.options = {.duration = 0}});
    uint32_t before = 0;
    for (const uint32_t axes : {6u, 14u, 26u, 62u}) {
        const auto fixed = manifoldsOf(scene, {.options = {.duration = 0, .fixed_axes = axes}});
        uint32_t touching = 0;
        for (uint32_t k = 0; k < fixed.size(); ++k) {
            touching += fixed[k].info.x > 0;
            const bool overlaps = exact[k].info.x > 0 && exact[k].points[0].arm_a.w < 0;
            if (overlaps) {
                EXPECT_GT(fixed[k].info.x, 0u) << k << " along " << axes;
            }
        }
        if (before > 0) {
            EXPECT_LE(touching, before);
        }
        before = touching;
    }
    HullScene boxes;
    const uint32_t box = boxes.add(boxShape({.5, .4, .3}));
    boxes.addPair({box}, {box, {.1, .1, .59}});
    boxes.addPair({box}, {box, {.1, .1, .63}});
    const auto fixed = manifoldsOf(boxes, {.options = {.fixed_axes = 6}});
    ASSERT_EQ(fixed[0].info.x, 4u);
    EXPECT_NEAR(fixed[0].normal.z, 1, 1e-6);
    for (const gpu::ContactPoint& p : fixed[0].points)
        EXPECT_NEAR(p.arm_a.w, -.01, 1e-6);
    EXPECT_EQ(fixed[1].info.x, 0u);
}

TEST(SmallHullSet, RefusesWhatIsNoHull) {
    brittle::HullSet set;
    const auto why = [&](const Shape& shape) {
        const auto added = brittle::addHull(set, shape.vertices, shape.loops);
        EXPECT_TRUE(set.records.empty() && set.vertices.empty() && set.edges.empty());
        return added ? std::string("taken") : added.error().message;
    };
    Shape open = boxShape({1, 1, 1}), dented = open, turned_over = open, many = open, wrong = open, broken = open;
    open.loops.pop_back();
    EXPECT_NE(why(open).find("open edge"), std::string::npos);
    dented.vertices[7] = {.2f, .2f, .2f};
    EXPECT_NE(why(dented).find("beyond face"), std::string::npos);
    std::ranges::reverse(turned_over.loops[2]);
    EXPECT_NE(why(turned_over).find("the same way"), std::string::npos);
    many.vertices.resize(HULL_VERTICES + 1);
    EXPECT_NE(why(many).find("the most is 124"), std::string::npos);
    wrong.loops[0][0] = 8;
    EXPECT_NE(why(wrong).find("not there"), std::string::npos);
    broken.vertices[0][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(why(broken).find("not a number"), std::string::npos);
    EXPECT_NE(why({}).find("less than three"), std::string::npos);
}

// Every edge runs from its first vertex to its second on the loop of its left face.
TEST(SmallHullSet, KnowsTheFacesOfItsEdges) {
    brittle::HullSet set;
    const Shape box = boxShape({.5, .4, .3});
    ASSERT_TRUE(brittle::addHull(set, box.vertices, box.loops));
    const auto runs = [&](uint32_t face, uint32_t from, uint32_t to) {
        const auto& loop = box.loops[face];
        for (size_t c = 0; c < loop.size(); ++c)
            if (loop[c] == from && loop[(c + 1) % loop.size()] == to) return true;
        return false;
    };
    ASSERT_EQ(set.edges.size(), 12u);
    for (const gpu::uvec4& e : set.edges) {
        EXPECT_TRUE(runs(e.z, e.x, e.y));
        EXPECT_TRUE(runs(e.w, e.y, e.x));
    }
    const gpu::HullRecord& record = set.records[0];
    EXPECT_EQ(record.count.y, 6u);
    EXPECT_NEAR(record.center.w, std::sqrt(.5), 1e-5);
    EXPECT_EQ(set.faces[3].plane.y, 1);
    EXPECT_EQ(set.faces[3].plane.w, .4f);
}

} // namespace
} // namespace kernel_test
