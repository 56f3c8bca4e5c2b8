// Hard scenes of many bodies, and those that ask for more than a scene: other bodies beside refused ones, room that runs out,
// sizes and weights far apart. See hard_scenes_test.cpp.
#include "modules/brittle/dynamics/body_order.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/check_scene.h"
#include "tests/engine/test_device.h"
#include "tests/reference/boxes.h"
#include "tests/support/known_shortfall.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace {

using brittle::Double3;
using brittle::operator-, brittle::operator*;
using support::knownShortfall;
using support::percentile;
using support::SceneRun;

double sizeOf(const Double3& v) { return std::hypot(std::hypot(v[0], v[1]), v[2]); }

TEST(HardScenes, hard_02_standing_block) {
    SceneRun run("hard_02_standing_block");
    run.finish();
    EXPECT_LE(run.meanWay(), 0.10);
    EXPECT_LE(percentile(run.overlaps(), 0.99), 2e-3);
    EXPECT_LE(run.kineticEnergy(), 1e-3);
}

double fastestEver(const std::string& name) {
    SceneRun run(name);
    double fastest = 0;
    for (uint32_t step = 0; step < run.scene().step.steps; step += 10) {
        run.step(10);
        fastest = std::max(fastest, run.fastest());
    }
    return fastest;
}

TEST(HardScenes, hard_04_inflated_100um) { EXPECT_LE(fastestEver("hard_04_inflated_100um"), 0.2); }
TEST(HardScenes, hard_04_inflated_1mm) { EXPECT_LE(fastestEver("hard_04_inflated_1mm"), 0.2); }
TEST(HardScenes, hard_04_inflated_10mm) {
    knownShortfall("speed of cells grown by 10 mm", fastestEver("hard_04_inflated_10mm"), 0.2);
}

TEST(HardScenes, hard_07_card_house) {
    SceneRun run("hard_07_card_house");
    const size_t top = run.scene().bodies.size() - 1;
    run.step(300);
    const Double3 before = run.place(top);
    run.finish();
    EXPECT_LE(-run.way(top)[1], 5e-3);
    EXPECT_LE(sizeOf(run.place(top) - before), 1e-5);
}

struct Slivers {
    double fastest, deepest;
};

Slivers restOf(const std::string& name) {
    SceneRun run(name);
    run.finish();
    EXPECT_TRUE(run.isFinite());
    return {run.fastest(), percentile(run.overlaps(), 1)};
}

TEST(HardScenes, hard_15_slivers_20mm) {
    const Slivers rest = restOf("hard_15_slivers_20mm");
    EXPECT_LE(rest.fastest, 1e-4);
    knownShortfall("overlap of slivers of 20 mm", rest.deepest, 1e-3);
}

TEST(HardScenes, hard_15_slivers_1mm) {
    const Slivers rest = restOf("hard_15_slivers_1mm");
    EXPECT_LE(rest.fastest, 1e-4);
    EXPECT_LE(rest.deepest, 1e-3);
}

// Momenta are compared with the sum of the sizes of those of all bodies, which cancel at the start.
TEST(HardScenes, hard_18_implosion) {
    SceneRun run("hard_18_implosion");
    const double energy = run.kineticEnergy();
    const Double3 linear = run.momentum(), angular = run.angularMomentum();
    const double all = run.momentumInAll(), all_angular = run.angularMomentumInAll();
    for (uint32_t step = 0; step < run.scene().step.steps; step += 5) {
        run.step(5);
        EXPECT_LE(run.kineticEnergy(), energy);
    }
    EXPECT_LE(sizeOf(run.momentum() - linear) / all, 1e-7);
    EXPECT_LE(sizeOf(run.angularMomentum() - angular) / all_angular, 2e-4);
}

// Some hull may still tip over after 5 s; which one is chance, so that energy is measured over several piles (below).
TEST(HardScenes, hard_20_pile_1000) {
    SceneRun run("hard_20_pile_1000");
    run.finish();
    const std::vector<double> overlaps = run.overlaps();
    EXPECT_LE(percentile(overlaps, 0.99), 5e-3);
    EXPECT_LE(percentile(overlaps, 1), 30e-3);
    size_t moving = 0;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        moving += run.speed(b) > 1e-3 ? 1 : 0;
    EXPECT_LE(moving, 10u);
}

// Nine piles that differ by hairs: all other energy is that of a hull that tips over, in less than half of them.
TEST(LongHardScenes, hard_20_pile_1000_comes_to_rest) {
    std::vector<double> energies;
    for (uint32_t k = 0; k < 9; ++k) {
        brittle::SceneDescription scene = SceneRun("hard_20_pile_1000").scene();
        for (brittle::BodyDescription& body : scene.bodies)
            body.place[0] += 1e-5 * k;
        SceneRun run(scene);
        run.finish();
        energies.push_back(run.kineticEnergy());
    }
    std::ranges::sort(energies);
    EXPECT_LE(percentile(energies, 0.5), 1e-3);
}

// Some hull of five thousand still tips over after 5 s.
TEST(LongHardScenes, hard_20_pile_5000) {
    SceneRun run("hard_20_pile_5000");
    run.finish();
    const std::vector<double> overlaps = run.overlaps();
    knownShortfall("overlap of 99 % of 5000 hulls", percentile(overlaps, 0.99), 5e-3);
    EXPECT_LE(percentile(overlaps, 1), 30e-3);
    knownShortfall("kinetic energy of 5000 hulls, J for 1000", run.kineticEnergy() / 5, 1e-3);
}

// What must be found for certain, and what may be, by boxes that are a little smaller and larger than those of the step.
void expectPairs(SceneRun& run) {
    const auto found = run.world().pairs();
    ASSERT_TRUE(found) << found.error().message;
    const auto must = reference::pairsThatMeet(run.sweptBoxes(-1e-4)), may = reference::pairsThatMeet(run.sweptBoxes(1e-4));
    EXPECT_TRUE(std::ranges::is_sorted(*found));
    EXPECT_TRUE(std::ranges::includes(*found, must)) << "pairs are missing";
    EXPECT_TRUE(std::ranges::includes(may, *found)) << "pairs that do not meet";
    EXPECT_GE(found->size(), must.size());
}

TEST(HardScenes, hard_22_far_body) {
    SceneRun run("hard_22_far_body");
    run.step(1);
    expectPairs(run);
}

// Of every scene that is made quickly.
TEST(World, PairsEqualBruteForceInEveryScene) {
    for (const brittle::SceneEntry& entry : brittle::builtinScenes()) {
        const auto scene = *brittle::makeBuiltinScene(entry.name);
        const brittle::SceneCounts counts = brittle::countsOf(scene);
        if (counts.bodies > 1200 || scene.budgets.pairs != 0) continue;
        SCOPED_TRACE(scene.name);
        SceneRun run(scene);
        run.step(1);
        expectPairs(run);
    }
}

// No contact is dropped: the slab is held up against each cube, and each cube lies on it.
TEST(HardScenes, hard_23_crowded_slab) {
    SceneRun run("hard_23_crowded_slab");
    run.finish();
    const auto counts = run.world().counts();
    ASSERT_TRUE(counts);
    EXPECT_GT(counts->colorless, 900u);
    EXPECT_GE(counts->contacts, 1001u);
    EXPECT_LE(run.furthestWay(), 1e-3);
    EXPECT_LE(percentile(run.overlaps(), 1), 1e-3);
}

TEST(HardScenes, hard_24_overflow) {
    SceneRun run("hard_24_overflow");
    std::vector<gpu::BodyState> before;
    for (uint32_t step = 0; step < run.scene().step.steps; ++step) {
        before = *run.world().bodies();
        const auto done = run.world().step(1);
        if (done) continue;
        EXPECT_EQ(done.error().code, engine::ErrorCode::Capacity);
        EXPECT_NE(done.error().message.find("room for 32; raise the budget of pairs"), std::string::npos)
            << done.error().message;
        const auto after = run.world().bodies();
        ASSERT_TRUE(after);
        EXPECT_EQ(std::memcmp(before.data(), after->data(), before.size() * sizeof(gpu::BodyState)), 0);
        return;
    }
    FAIL() << "a hundred hulls met in 32 pairs";
}

std::vector<gpu::BodyState> afterSteps(const brittle::WorldContents& contents) {
    auto world = brittle::World::create(engine_test::device(), contents);
    EXPECT_TRUE(world);
    EXPECT_TRUE((*world)->step(60));
    return *(*world)->bodies();
}

// Where a body is refused, the world is as if nobody had tried to add it.
void expectRefused(std::string_view number) {
    const brittle::WorldContents sound = [] {
        auto scene = *brittle::makeBuiltinScene("stack_3");
        return *brittle::contentsOf(scene, ".", nullptr);
    }();
    const std::vector<gpu::BodyState> expected = afterSteps(sound);
    size_t refused_count = 0;
    for (const brittle::RefusedScene& refused : brittle::refusedScenes()) {
        if (refused.scene.name.find(number) == std::string::npos) continue;
        SCOPED_TRACE(refused.scene.name);
        ++refused_count;
        const auto checked = brittle::checkScene(refused.scene);
        ASSERT_FALSE(checked);
        EXPECT_EQ(checked.error().code, engine::ErrorCode::BadInput);
        EXPECT_NE(checked.error().message.find("'bad'"), std::string::npos) << checked.error().message;
    }
    EXPECT_GT(refused_count, 3u);
    const std::vector<gpu::BodyState> after = afterSteps(sound);
    EXPECT_EQ(std::memcmp(expected.data(), after.data(), after.size() * sizeof(gpu::BodyState)), 0);
}

TEST(HardScenes, hard_25_bodies_without_numbers) { expectRefused("hard_25"); }
TEST(HardScenes, hard_26_degenerate_hulls) { expectRefused("hard_26"); }

uint64_t hashAfter(brittle::World& world, uint32_t steps) {
    EXPECT_TRUE(world.step(steps));
    const auto hash = world.hash();
    EXPECT_TRUE(hash);
    return hash ? *hash : 0;
}

TEST(LongHardScenes, hard_29_determinism) {
    const auto scene = *brittle::makeBuiltinScene("hard_29_determinism");
    auto contents = brittle::contentsOf(scene, ".", nullptr);
    ASSERT_TRUE(contents);
    std::iota(contents->ids.begin(), contents->ids.end(), 0);
    brittle::BodyOrder backward = brittle::orderById(*contents);
    std::ranges::reverse(backward.body_at);
    const auto make = [&](const brittle::WorldContents& of, uint32_t group_size) {
        return std::move(*brittle::World::create(engine_test::device(), of, {}, {0, 0, group_size}));
    };
    const auto whole = make(*contents, 64), other = make(*contents, 256), resumed = make(*contents, 128);
    const uint64_t expected = hashAfter(*whole, scene.step.steps);
    EXPECT_EQ(hashAfter(*make(brittle::inOrder(*contents, backward), 64), scene.step.steps), expected);
    EXPECT_EQ(hashAfter(*other, 300), hashAfter(*resumed, 300));
    const auto saved = other->save();
    ASSERT_TRUE(saved);
    ASSERT_TRUE(resumed->restore(*saved));
    EXPECT_EQ(hashAfter(*other, 300), expected);
    EXPECT_EQ(hashAfter(*resumed, 300), expected);
}

// In units of the edge.
std::vector<Double3> placesInEdges(const std::string& name, double edge) {
    SceneRun run(name);
    run.finish();
    std::vector<Double3> places;
    for (size_t b = 0; b < run.scene().bodies.size(); ++b)
        places.push_back((1 / edge) * run.place(b));
    return places;
}

void expectAlike(const std::vector<Double3>& places, const std::vector<Double3>& expected) {
    for (size_t b = 0; b < places.size(); ++b)
        EXPECT_LE(sizeOf(places[b] - expected[b]), 0.05 * expected[b][1]) << b;
}

TEST(HardScenes, hard_31_weights) {
    const std::vector<Double3> expected = placesInEdges("hard_31_edge_1m", 1);
    expectAlike(placesInEdges("hard_31_density_10", 1), expected);
    expectAlike(placesInEdges("hard_31_density_10000", 1), expected);
}

TEST(HardScenes, hard_31_sizes) {
    const std::vector<Double3> expected = placesInEdges("hard_31_edge_1m", 1);
    expectAlike(placesInEdges("hard_31_edge_10mm", 0.01), expected);
    expectAlike(placesInEdges("hard_31_edge_100mm", 0.1), expected);
    expectAlike(placesInEdges("hard_31_edge_10m", 10), expected);
    expectAlike(placesInEdges("hard_31_edge_100m", 100), expected);
}

TEST(HardScenes, hard_32_sleep) {
    SceneRun run("hard_32_sleep");
    run.step(600);
    const auto counts = run.world().counts();
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->awake, 0u);
    EXPECT_EQ(counts->groups, 0u);
    EXPECT_EQ(run.kineticEnergy(), 0);
}

TEST(LongHardScenes, hard_33_rest) {
    SceneRun run("hard_33_rest");
    run.finish();
    EXPECT_LE(run.furthestWay(), 1e-3);
}

} // namespace
