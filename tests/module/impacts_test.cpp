// What the host hears of blows that break nothing: where, between whom, how hard; no more and no less.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription;

constexpr double kDensity = 2000, kEdge = 0.2, kMass = kDensity * kEdge * kEdge * kEdge;

SceneDescription quietScene(std::vector<BodyDescription> bodies, bool floor = true) {
    for (BodyDescription& body : bodies)
        body.density = kDensity;
    SceneDescription scene = sceneOf(std::move(bodies), floor);
    scene.effects = {"gravity", "contacts", "friction", "events"};
    return scene;
}

BodyDescription cube(Double3 place, double edge = kEdge) {
    BodyDescription body;
    body.shape.size = {edge, edge, edge};
    body.place = place;
    return body;
}

std::vector<gpu::ImpactEvent> impactsOf(brittle::World& world) {
    auto heard = world.impacts();
    EXPECT_TRUE(heard);
    return heard->events;
}

Double3 placeOf(const gpu::ImpactEvent& e) {
    return {SECTOR_EDGE * e.sector.x + double{e.offset.x}, SECTOR_EDGE * e.sector.y + double{e.offset.y},
            SECTOR_EDGE * e.sector.z + double{e.offset.z}};
}

TEST(Impacts, WhatLandsFlatIsHeardOnceWithTheEnergyOfItsFall) {
    const double height = 1;
    const auto world = worldOf(quietScene({cube({3, height + kEdge / 2, -2})}));
    step(*world, 120);
    const auto events = impactsOf(*world);
    ASSERT_EQ(events.size(), 1u) << "what lies there is no impact";
    const gpu::ImpactEvent& e = events[0];
    EXPECT_EQ(e.what.y, 0u);
    EXPECT_EQ(e.what.z, 1u);
    EXPECT_EQ(e.born.z, 0u);
    EXPECT_EQ(e.born.w, 1u);
    EXPECT_NEAR(e.what.x, std::sqrt(2 * height / 9.81) * 60, 1.5);
    EXPECT_NEAR(e.measures.x, kMass, 1e-3 * kMass);
    EXPECT_NEAR(e.measures.y, std::sqrt(2 * 9.81 * height), 0.01 * e.measures.y);
    EXPECT_NEAR(e.measures.z, 9.81 * height * kMass, 0.01 * e.measures.z);
    EXPECT_NEAR(e.measures.w, kMass * e.measures.y, 0.02 * e.measures.w) << "it was stopped";
    const Double3 place = placeOf(e);
    EXPECT_NEAR(place[0], 3, 1e-3);
    EXPECT_NEAR(place[1], 0, 1e-3) << "on what does not move";
    EXPECT_NEAR(place[2], -2, 1e-3);
    EXPECT_NEAR(std::abs(e.along.y), 1, 1e-6);
    EXPECT_TRUE(impactsOf(*world).empty()) << "each is told once";
}

TEST(Impacts, OfTwoThatMeetInTheAirCountsWhatMovesThemTogether) {
    auto left = cube({-0.5, 0, 0}), right = cube({0.5, 0, 0});
    left.velocity = {4, 0, 0};
    right.velocity = {-2, 0, 0};
    SceneDescription scene = quietScene({left, right}, false);
    scene.gravity = {0, 0, 0};
    const auto world = worldOf(scene);
    step(*world, 30);
    const auto events = impactsOf(*world);
    ASSERT_EQ(events.size(), 1u);
    const double mass = kMass / 2, energy = 0.5 * mass * 36;
    EXPECT_NEAR(events[0].measures.x, mass, 1e-3 * mass);
    EXPECT_NEAR(events[0].measures.y, 6, 1e-3);
    EXPECT_NEAR(events[0].measures.z, energy, 2e-3 * energy);
    EXPECT_NEAR(events[0].along.x, 1, 1e-3) << "from the first to the second";
    const double meets_at = -0.5 + kEdge / 2 + 4 * (1 - kEdge) / 6;
    EXPECT_NEAR(placeOf(events[0])[0], meets_at, 4.0 / 60) << "to what they go in a step";
}

TEST(Impacts, AFaceThatLandsFlatCountsWholeAndACornerCountsLess) {
    BodyDescription flat = cube({0, 0.5, 0}), tilted = cube({2, 0.5, 0});
    tilted.turn = {0.3, 0.1, 0.5, 0.8};
    const auto world = worldOf(quietScene({flat, tilted}));
    double whole = 0, part = 1e9;
    for (uint32_t k = 0; k < 60; ++k) {
        step(*world);
        for (const gpu::ImpactEvent& e : impactsOf(*world))
            if (e.what.y == 0) {
                EXPECT_EQ(e.what.w, 4u);
                whole = e.measures.x;
            } else if (part == 1e9) {
                part = e.measures.x;
            }
    }
    EXPECT_NEAR(whole, kMass, 1e-3 * kMass);
    EXPECT_LT(part, 0.8 * kMass);
    EXPECT_GT(part, 0.1 * kMass);
}

TEST(Impacts, WhatMeetsMoreSlowlyThanAskedForIsNotTold) {
    SceneDescription scene = quietScene({cube({0, 0.06 + kEdge / 2, 0}), cube({3, 0.6 + kEdge / 2, 0})});
    const auto heard = [&](double least_speed) {
        scene.events.impact_speed = least_speed;
        const auto world = worldOf(scene);
        step(*world, 60);
        return impactsOf(*world).size();
    };
    EXPECT_EQ(heard(0.25), 2u);
    EXPECT_EQ(heard(2), 1u);
    EXPECT_EQ(heard(20), 0u);
}

TEST(Impacts, WhatBreaksIsABreakAndNoImpact) {
    SceneDescription scene = sceneOf({ball({0, 2, 0}, "glass"), ball({3, 0.5, 0}, "")});
    scene.bodies[1].density = kDensity;
    const auto world = worldOf(scene);
    uint32_t broke_in = 0;
    for (uint32_t k = 0; k < 60 && broke_in == 0; ++k) {
        step(*world);
        const auto breaks = world->breaks();
        ASSERT_TRUE(breaks);
        for (const gpu::BreakEvent& e : breaks->events)
            broke_in = e.what.x;
    }
    ASSERT_GT(broke_in, 0u);
    for (const gpu::ImpactEvent& e : impactsOf(*world))
        EXPECT_EQ(e.what.y, 1u) << "the glass was only hit when it broke";
    step(*world, 30);
    uint32_t of_fragments = 0;
    for (const gpu::ImpactEvent& e : impactsOf(*world))
        for (const auto& [born, origin, slot] :
             {std::array{e.born.x, e.born.z, e.what.y}, std::array{e.born.y, e.born.w, e.what.z}}) {
            if (born == 0) {
                EXPECT_EQ(origin, slot);
                continue;
            }
            ++of_fragments;
            EXPECT_EQ(born, broke_in);
            EXPECT_EQ(origin, 0u);
        }
    EXPECT_GT(of_fragments, 10u);
}

// All land in the first step, each faster than the one before.
SceneDescription shower(uint32_t bodies) {
    std::vector<BodyDescription> all;
    for (uint32_t k = 0; k < bodies; ++k) {
        all.push_back(cube({0.3 * (k % 30), 0.051, 0.3 * (k / 30)}, 0.1));
        all.back().velocity = {0, -1 - 0.02 * (k * 7 % bodies), 0};
    }
    return quietScene(std::move(all));
}

TEST(Impacts, OfVeryManyInAStepTheHardestAreTold) {
    constexpr uint32_t kBodies = 600;
    const auto world = worldOf(shower(kBodies));
    step(*world);
    const auto events = impactsOf(*world);
    ASSERT_EQ(events.size(), uint32_t{MOST_IMPACTS});
    std::vector<bool> is_told(kBodies);
    double weakest = 1e9, loudest_untold = 0;
    for (const gpu::ImpactEvent& e : events) {
        EXPECT_FALSE(is_told[e.what.y]) << "twice";
        is_told[e.what.y] = true;
        weakest = std::min(weakest, double{e.measures.z});
    }
    for (uint32_t k = 0; k < kBodies; ++k) {
        const double speed = 1 + 0.02 * (k * 7 % kBodies);
        if (!is_told[k]) loudest_untold = std::max(loudest_untold, 0.5 * kDensity * 1e-3 * speed * speed);
    }
    EXPECT_LT(loudest_untold, 2 * weakest) << "to a power of two";
}

TEST(Impacts, AreTheSameInEveryRunAndWithGroupsOfAnySize) {
    const auto run = [](uint32_t group_size) {
        const auto world = worldOf(shower(300), {.group_size = group_size});
        step(*world, 3);
        return impactsOf(*world);
    };
    const auto first = run(64), again = run(64), small = run(32);
    ASSERT_EQ(first.size(), again.size());
    ASSERT_EQ(first.size(), small.size());
    const auto bytes = [](const auto& events) { return std::as_bytes(std::span(events)); };
    EXPECT_TRUE(std::ranges::equal(bytes(first), bytes(again)));
    EXPECT_TRUE(std::ranges::equal(bytes(first), bytes(small)));
}

TEST(Impacts, TellingChangesNoBit) {
    SceneDescription scene = shower(60);
    const auto told = worldOf(scene);
    std::erase(scene.effects, "events");
    const auto silent = worldOf(scene);
    step(*told, 40);
    step(*silent, 40);
    EXPECT_FALSE(impactsOf(*told).empty());
    EXPECT_TRUE(impactsOf(*silent).empty());
    EXPECT_EQ(*told->hash(), *silent->hash());
}

TEST(Impacts, ThatNobodyAskedForInTimeAreCounted) {
    constexpr uint32_t kBodies = 250;
    SceneDescription scene = shower(kBodies);
    for (BodyDescription& body : scene.bodies)
        body.surface.restitution = 1;
    scene.effects.push_back("restitution");
    const auto world = worldOf(scene), asked = worldOf(scene);
    uint32_t all = 0;
    for (uint32_t k = 0; k < 300; ++k) {
        step(*asked);
        all += static_cast<uint32_t>(impactsOf(*asked).size());
    }
    ASSERT_GT(all, uint32_t{IMPACT_EVENTS});
    step(*world, 300);
    const auto heard = world->impacts();
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->events.size(), uint32_t{IMPACT_EVENTS});
    EXPECT_EQ(heard->lost, all - IMPACT_EVENTS);
    EXPECT_TRUE(std::ranges::is_sorted(heard->events, {}, [](const auto& e) { return e.what.x; }));
}

TEST(Impacts, ASavedStateKnowsWhichHaveBeenTold) {
    const auto world = worldOf(quietScene({cube({0, 0.3 + kEdge / 2, 0}), cube({3, 1 + kEdge / 2, 0})}));
    step(*world, 20);
    EXPECT_EQ(impactsOf(*world).size(), 1u);
    const auto state = world->save();
    step(*world, 30);
    EXPECT_EQ(impactsOf(*world).size(), 1u);
    ASSERT_TRUE(world->restore(*state));
    EXPECT_TRUE(impactsOf(*world).empty());
    step(*world, 30);
    EXPECT_EQ(impactsOf(*world).size(), 1u);
}

} // namespace
