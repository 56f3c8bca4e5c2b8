// Small fragments that have come to rest fade, go, and give back what they had: the effect `debris_lifetime`.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/small_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

namespace {

using breaking_scenes::worldOf, breaking_scenes::step, breaking_scenes::presentBodies;
using brittle::Double3;
using small_pieces::sceneOf, small_pieces::firstBreaks, small_pieces::countsOf;

constexpr double kStep = 1.0 / 60;

// A cube that falls flat, breaks into a few pieces, and has them lie about.
brittle::BodyDescription cube(const Double3& place, double edge = 0.1) {
    brittle::BodyDescription body;
    body.shape.size = {edge, edge, edge};
    body.place = place;
    body.material = "brittle stuff";
    return body;
}

// Breaks from half a meter, and into few pieces.
brittle::MaterialDescription brittleStuff() {
    brittle::MaterialDescription material;
    material.name = "brittle stuff";
    material.like = "brick";
    material.tensile_strength = 1e5;
    material.weibull_modulus = 1000;
    material.eta = 0.1;
    return material;
}

brittle::SceneDescription debrisScene(std::vector<brittle::BodyDescription> bodies, std::vector<std::string> effects = {}) {
    effects.emplace_back("debris_lifetime");
    brittle::SceneDescription scene = sceneOf(std::move(bodies), std::move(effects));
    scene.materials.push_back(brittleStuff());
    scene.debris = {.below = 1, .after = 0.2, .fade = 0.2};
    return scene;
}

// Steps, for so many at most, until no fragment is left; returns how many that were.
uint32_t stepUntilAllAreGone(brittle::World& world, uint32_t most = 600) {
    for (uint32_t k = 1; k <= most; ++k) {
        step(world);
        if (world.fragments()->empty()) return k;
    }
    return most + 1;
}

TEST(Debris, GoesAfterItsTimeAndGivesBackWhatItHad) {
    for (const bool sleeping : {false, true}) {
        brittle::SceneDescription scene = debrisScene({cube({0, 1, 0})});
        if (sleeping) scene.effects.emplace_back("sleeping");
        const auto world = worldOf(scene);
        const auto before = countsOf(*world).in_use;
        const auto events = firstBreaks(*world);
        ASSERT_EQ(events.size(), 1u);
        ASSERT_GT(events[0].made.x, 1u);
        EXPECT_LT(stepUntilAllAreGone(*world), 600u);
        const auto after = countsOf(*world);
        EXPECT_EQ(after.expired, events[0].made.x);
        EXPECT_TRUE(presentBodies(*world).empty());
        EXPECT_EQ(after.in_use[POOL_BODIES], before[POOL_BODIES] - 1) << "only the ground is left";
        EXPECT_EQ(after.in_use[POOL_PIECES], 1u);
        EXPECT_EQ(after.in_use[POOL_TRIANGLES], 0u);
        EXPECT_EQ(after.pool_faults, 0u);
        step(*world, 5);
        EXPECT_EQ(countsOf(*world).pairs, 0u);
    }
}

TEST(Debris, FadesOnlyOnceItHasBeenAtRest) {
    brittle::SceneDescription scene = debrisScene({cube({0, 1, 0})});
    scene.debris = {.below = 1, .after = 0.5, .fade = 0.5};
    const auto world = worldOf(scene);
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    std::map<uint32_t, std::vector<float>> fades; // by slot: nothing else breaks
    for (uint32_t k = 0; k < 600; ++k) {
        const auto fragments = world->fragments();
        for (const brittle::BodyFragment& fragment : *fragments)
            fades[fragment.slot].push_back(fragment.fade);
        step(*world);
    }
    EXPECT_TRUE(world->fragments()->empty());
    for (const auto& [slot, list] : fades) {
        const auto begins = std::ranges::find_if(list, [](float fade) { return fade < 1; });
        ASSERT_NE(begins, list.end());
        EXPECT_GE(begins - list.begin(), 30) << "half a second of rest";
        EXPECT_NEAR(static_cast<double>(list.end() - begins), 29, 2) << "half a second of fading";
        EXPECT_TRUE(std::ranges::is_sorted(list, std::greater()));
        for (auto fade = begins + 1; fade != list.end(); ++fade)
            EXPECT_NEAR(*(fade - 1) - *fade, kStep / 0.5, 1e-3);
    }
}

TEST(Debris, IsNeitherWhatIsLargeNorWhatWasThereFromTheBeginning) {
    brittle::BodyDescription pebble = cube({2, 0.01, 0}, 0.02);
    brittle::SceneDescription scene = debrisScene({cube({0, 1, 0}), pebble});
    const auto probe = worldOf(scene);
    ASSERT_EQ(firstBreaks(*probe).size(), 1u);
    std::vector<double> sizes;
    const auto fragments = probe->fragments();
    for (const brittle::BodyFragment& fragment : *fragments)
        sizes.push_back(std::cbrt(double{fragment.record.form.x}));
    std::ranges::sort(sizes);
    ASSERT_GT(sizes.size(), 2u);
    const size_t middle = sizes.size() / 2;
    scene.debris.below = (sizes[middle - 1] + sizes[middle]) / 2;
    const auto world = worldOf(scene);
    step(*world, 300);
    EXPECT_EQ(countsOf(*world).expired, middle);
    EXPECT_EQ(world->fragments()->size(), sizes.size() - middle);
    EXPECT_EQ(presentBodies(*world).size(), sizes.size() - middle + 1) << "and the pebble";
}

// A cube that has broken in place carries a plate, and all sleep.
TEST(Debris, WhatRestedOnItWakesAndFalls) {
    brittle::BodyDescription plate;
    plate.name = "plate";
    plate.shape.size = {0.15, 0.04, 0.15};
    plate.place = {0, 0.6, 0};
    plate.mass = 1;
    brittle::SceneDescription scene = debrisScene({cube({0, 0.25, 0}, 0.2), plate}, {"sleeping"});
    scene.bodies[0].velocity = {0, -3, 0};
    scene.materials[0].eta = 0.04;
    scene.debris = {.below = 1, .after = 3, .fade = 0.2};
    const auto world = worldOf(scene);
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    bool slept = false;
    double high = 0;
    for (uint32_t k = 0; k < 900 && !world->fragments()->empty(); ++k) {
        step(*world);
        const gpu::BodyState state = (*world->bodies())[1];
        const bool sleeps = (state.sector.w & BODY_ASLEEP) != 0;
        if (sleeps) high = brittle::poseOf(state).place[1];
        slept = slept || sleeps;
    }
    ASSERT_TRUE(slept) << "on its fragments";
    ASSERT_GT(high, 0.1) << "above the ground";
    ASSERT_TRUE(world->fragments()->empty());
    step(*world, 120);
    EXPECT_NEAR(brittle::poseOf((*world->bodies())[1]).place[1], 0.02, 2e-3);
}

// ---- bit for bit ----------------------------------------------------------------------------------------------------------

brittle::SceneDescription threeCubes() {
    return debrisScene({cube({0, 1, 0}), cube({1, 1.5, 0}), cube({2, 2, 0})}, {"sleeping", "dust"});
}

TEST(Debris, IsTheSameBitForBitInEveryRunAndWithGroupsOfAnySize) {
    std::vector<std::vector<uint64_t>> hashes;
    for (const uint32_t group_size : {64u, 64u, 32u}) {
        brittle::WorldBudget budget;
        budget.group_size = group_size;
        const auto world = worldOf(threeCubes(), budget);
        std::vector<uint64_t>& list = hashes.emplace_back();
        for (uint32_t k = 0; k < 30; ++k) {
            step(*world, 10);
            list.push_back(*world->hash());
        }
        EXPECT_GT(countsOf(*world).expired, 3u);
    }
    for (const auto& list : hashes)
        EXPECT_EQ(list, hashes[0]);
}

TEST(Debris, GoesOnFromASavedStateInTheMiddleOfFading) {
    const auto world = worldOf(threeCubes());
    const auto isFading = [](const brittle::BodyFragment& fragment) { return fragment.fade < 1; };
    for (uint32_t k = 0; k < 600 && std::ranges::none_of(*world->fragments(), isFading); ++k)
        step(*world);
    ASSERT_TRUE(std::ranges::any_of(*world->fragments(), isFading));
    const auto state = world->save();
    const auto goOn = [&] {
        step(*world, 60);
        const auto counts = countsOf(*world);
        return std::pair(*world->hash(), std::pair(counts.expired, counts.in_use));
    };
    const auto first = goOn();
    ASSERT_TRUE(world->restore(*state));
    EXPECT_TRUE(std::ranges::any_of(*world->fragments(), isFading));
    EXPECT_EQ(goOn(), first);
    EXPECT_GT(first.second.first, 0u);
}

// ---- many -----------------------------------------------------------------------------------------------------------------

// Cubes beside each other that fall from ever higher up, so that some break in every step while others go.
brittle::SceneDescription rain(uint32_t rows, uint32_t columns) {
    std::vector<brittle::BodyDescription> bodies;
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column)
            bodies.push_back(cube({0.5 * column, 1 + 0.02 * row, 0.5 * row}, 0.05));
    brittle::SceneDescription scene = debrisScene(std::move(bodies));
    scene.debris = {.below = 1, .after = 0.05, .fade = 0.05};
    return scene;
}

struct Cycles {
    uint64_t broken = 0, fragments = 0, expired = 0;
    uint32_t most_in_use = 0;
};

// Until all have broken and all that they broke into has gone.
Cycles runToTheEnd(const brittle::SceneDescription& scene, uint32_t most_steps) {
    brittle::WorldBudget budget;
    budget.breaking.fragments = 3072;
    budget.breaking.step_bodies = 64;
    const auto world = worldOf(scene, budget);
    const auto before = countsOf(*world).in_use;
    Cycles cycles;
    for (uint32_t k = 0; k < most_steps; ++k) {
        step(*world);
        const auto breaks = world->breaks();
        for (const gpu::BreakEvent& event : breaks->events)
            cycles.broken += event.made.y == 0 ? 1 : 0;
        const auto counts = countsOf(*world);
        EXPECT_EQ(counts.pool_faults, 0u);
        cycles.fragments = counts.fragments;
        cycles.expired = counts.expired;
        cycles.most_in_use = std::max(cycles.most_in_use, counts.in_use[POOL_BODIES]);
        if (cycles.broken == scene.bodies.size() && cycles.expired == cycles.fragments) break;
    }
    const auto after = countsOf(*world).in_use;
    EXPECT_EQ(after[POOL_BODIES], before[POOL_BODIES] - scene.bodies.size());
    EXPECT_EQ(after[POOL_PIECES], before[POOL_PIECES] - scene.bodies.size());
    EXPECT_EQ(after[POOL_TRIANGLES], 0u);
    EXPECT_EQ(cycles.broken, scene.bodies.size());
    EXPECT_EQ(cycles.expired, cycles.fragments);
    return cycles;
}

TEST(Debris, HundredsOfBreaksLeavePoolsAsTheyWere) {
    const Cycles cycles = runToTheEnd(rain(20, 15), 400);
    EXPECT_EQ(cycles.broken, 300u);
    EXPECT_GT(cycles.fragments, 600u);
}

TEST(LongDebris, TenThousandBreaksLeavePoolsAsTheyWere) {
    uint64_t broken = 0, fragments = 0;
    for (uint32_t k = 0; k < 20; ++k) {
        const Cycles cycles = runToTheEnd(rain(25, 20), 400);
        broken += cycles.broken;
        fragments += cycles.fragments;
    }
    EXPECT_EQ(broken, 10'000u);
    std::printf("10,000 bodies broke into %llu fragments, which have gone\n", static_cast<unsigned long long>(fragments));
}

// ---- what it costs --------------------------------------------------------------------------------------------------------

TEST(DebrisGates, WhereItIsOffThereAreNoBytesNoPassesAndNoKernels) {
    brittle::SceneDescription scene = debrisScene({cube({0, 1, 0})}, {"sleeping"});
    const auto on = worldOf(scene)->plan();
    std::erase(scene.effects, "debris_lifetime");
    const auto off = worldOf(scene)->plan();
    ASSERT_TRUE(on && off);
    EXPECT_GT(on->bytesOf(brittle::Effect::DebrisLifetime), 0u);
    EXPECT_EQ(off->bytesOf(brittle::Effect::DebrisLifetime), 0u);
    for (const char* kernel : {"age_debris", "list_debris", "wake_debris", "expire_debris"}) {
        EXPECT_EQ(std::ranges::count(on->passes, kernel, &brittle::Pass::kernel), 1) << kernel;
        EXPECT_EQ(std::ranges::count(off->passes, kernel, &brittle::Pass::kernel), 0) << kernel;
        EXPECT_EQ(std::ranges::count(off->kernels, kernel), 0) << kernel;
    }
}

// Told and not judged: where nothing has broken.
TEST(DebrisGates, TheCostIsTold) {
    for (const bool on : {false, true}) {
        brittle::SceneDescription scene = debrisScene({cube({0, 0.05, 0})});
        if (!on) std::erase(scene.effects, "debris_lifetime");
        const auto world = worldOf(scene);
        step(*world, 10);
        const auto us = world->measure(20);
        const auto plan = world->plan();
        ASSERT_TRUE(us && plan);
        std::printf("debris_lifetime %-3s: %9llu bytes, %8.1f us\n", on ? "on" : "off",
                    static_cast<unsigned long long>(plan->bytes()), std::accumulate(us->begin(), us->end(), 0.0));
    }
}

} // namespace
