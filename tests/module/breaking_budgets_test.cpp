// Worlds in which things break with too little room for it: they go on, and the host hears what there should have been more of.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::SceneDescription;

// Triangles of surfaces: nothing is lost by the attempt.
TEST(BreakingBudgets, OfTwoThatDoNotFitTogetherOneBreaksAndTheOtherIsTold) {
    brittle::WorldBudget budget;
    budget.breaking.triangles = 6000;
    budget.breaking.most_fragments = 128;
    const auto world = worldOf(sceneOf({ball({0, 3, 0}, "glass"), ball({1, 3, 0}, "glass")}), budget);
    const double mass = massOf(presentBodies(*world));
    const auto events = stepUntilItBreaks(*world, 60);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_GT(events[0].made.x, 100u);
    EXPECT_EQ(events[1].made.x, 0u);
    EXPECT_EQ(events[1].made.y, uint32_t{WHOLE_NO_ROOM});
    EXPECT_GT(events[1].lacked.w, 0u);
    EXPECT_NEAR(massOf(presentBodies(*world)), mass, 1e-6 * mass);
}

// Twelve balls that hit the ground one after the other, with room for 128 fragments.
TEST(BreakingBudgets, WhereFragmentsRunShortAllBodiesBreakIntoFewer) {
    std::vector<BodyDescription> balls;
    for (int k = 0; k < 12; ++k) {
        balls.push_back(ball({0.5 * k, 0.2 + 0.1 * k, 0}, "glass"));
        balls.back().velocity = {0, -12, 0};
    }
    SceneDescription scene = sceneOf(balls);
    scene.effects.emplace_back("refracture");
    brittle::WorldBudget budget;
    budget.breaking.fragments = 128;
    const auto world = worldOf(scene, budget);
    uint32_t first = 0, broken = 0;
    for (uint32_t k = 0; k < 30; ++k) {
        step(*world);
        const auto breaks = world->breaks();
        ASSERT_TRUE(breaks);
        for (const gpu::BreakEvent& event : breaks->events) {
            if (event.what.y >= 12) continue; // a fragment
            EXPECT_EQ(event.made.y, 0u) << "ball " << event.what.y;
            EXPECT_GE(event.made.x, 2u);
            if (broken++ == 0) first = event.made.x;
        }
    }
    EXPECT_EQ(broken, 12u);
    EXPECT_GT(first, 10u);
}

// A heap of balls, so many that a small budget of pairs does not do.
SceneDescription heapOfBalls() {
    std::vector<BodyDescription> balls;
    for (int k = 0; k < 64; ++k)
        balls.push_back(ball({0.199 * (k % 4), 0.1 + 0.199 * (k / 16), 0.199 * (k / 4 % 4)}, "concrete"));
    return sceneOf(balls);
}

TEST(BreakingBudgets, AStepThatFailedForWantOfPairsIsMadeOnceThereIsRoom) {
    brittle::WorldBudget budget;
    budget.pairs = 20;
    const auto world = worldOf(heapOfBalls(), budget), roomy = worldOf(heapOfBalls());
    for (int k = 0; k < 2; ++k) {
        const auto refused = world->step();
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, engine::ErrorCode::Capacity);
    }
    const auto lower = world->setPairBudget(10, 0);
    ASSERT_FALSE(lower);
    EXPECT_NE(lower.error().message.find("can only be raised"), std::string::npos) << lower.error().message;
    EXPECT_FALSE(world->setPairBudget(UINT32_MAX / 2, 0)) << "more than the device can bind";
    EXPECT_FALSE(world->step()) << "the budget is as it was";
    for (const uint32_t pairs : {2000u, 0u}) {
        const auto raised = world->setPairBudget(pairs, 0);
        ASSERT_TRUE(raised) << raised.error().message;
        step(*world, 10);
        step(*roomy, 10);
        EXPECT_EQ(*world->hash(), *roomy->hash());
    }
}

struct Outcomes {
    uint32_t broke = 0, refused = 0;
};

// Steps with room for so many pairs or contacts, which end nothing: what would need more stays whole, and the host hears of it.
void stepWithRoomFor(uint32_t room, bool of_contacts, const SceneDescription& scene, Outcomes& outcomes) {
    brittle::WorldBudget budget;
    (of_contacts ? budget.contacts : budget.pairs) = room;
    const auto world = worldOf(scene, budget);
    const double mass = massOf(presentBodies(*world));
    double dust = 0;
    for (uint32_t k = 0; k < 20; ++k) {
        const auto made = world->step();
        ASSERT_TRUE(made) << room << (of_contacts ? " contacts: " : " pairs: ") << made.error().message;
        const auto breaks = world->breaks();
        for (const gpu::BreakEvent& event : breaks->events) {
            dust += double{event.offset.w};
            (event.made.y == 0 ? outcomes.broke : outcomes.refused)++;
            if (event.made.y == 0) continue;
            EXPECT_EQ(event.made.y, uint32_t{WHOLE_NO_PAIRS});
            EXPECT_GT(of_contacts ? event.lacked.y : event.lacked.x, 0u);
        }
    }
    EXPECT_NEAR(massOf(presentBodies(*world)) + dust, mass, 1e-5 * mass);
}

TEST(BreakingBudgets, NoBudgetOfPairsOrContactsEndsIt) {
    auto fast = ball({0, 0.5, 0}, "glass"), other = ball({1, 0.6, 0}, "concrete");
    fast.velocity = other.velocity = {0, -15, 0};
    const SceneDescription scene = sceneOf({fast, other});
    Outcomes outcomes;
    for (const bool of_contacts : {false, true})
        for (const uint32_t room : {8u, 100u, 500u, 2000u, 6000u, 12000u, 20000u, 40000u})
            stepWithRoomFor(room, of_contacts, scene, outcomes);
    EXPECT_GE(outcomes.broke, 8u);
    EXPECT_GE(outcomes.refused, 8u);
}

// A ball that flies into another on a bed of blocks: of its fragments each may be near any of them.
TEST(LongBreakingBudgets, NoBudgetOfPairsEndsItAmongManyNeighbors) {
    auto fast = ball({0, 0.62, 0}, "glass"), struck = ball({0, 0.4, 0}, "glass");
    fast.velocity = {0, -15, 0};
    std::vector<BodyDescription> bodies = {fast, struck};
    for (int k = 0; k < 25; ++k) {
        BodyDescription& block = bodies.emplace_back();
        block.shape.size = {0.08, 0.25, 0.08};
        block.place = {0.08 * (k % 5 - 2), 0.126, 0.08 * (k / 5 - 2)};
    }
    const SceneDescription scene = sceneOf(std::move(bodies));
    Outcomes outcomes;
    for (const uint32_t room : {200u, 16000u, 200000u})
        stepWithRoomFor(room, false, scene, outcomes);
    EXPECT_GE(outcomes.broke, 2u);
    EXPECT_GE(outcomes.refused, 4u);
}

TEST(BreakingBudgets, WhatNoStepHasRoomForSaysWhichBudgetLacksHowMuch) {
    brittle::WorldBudget budget;
    budget.breaking.step_triangles = 10;
    const SceneDescription scene = sceneOf({ball({0, 3, 0}, "glass")});
    const auto world = worldOf(scene, budget);
    const auto events = stepUntilItBreaks(*world, 60);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].made.y, uint32_t{WHOLE_TOO_LARGE});
    const auto surface = brittle::contentsOf(scene, {}, nullptr)->breakable.at(0).surface;
    EXPECT_EQ(events[0].lacked.x, (surface.y + surface.z) / 3 - 10);
    EXPECT_EQ(events[0].lacked.y, 0u);
}

engine::Result<std::unique_ptr<brittle::World>> tryWorldOfABall(const brittle::BreakingBudget& breaking) {
    const SceneDescription scene = sceneOf({ball({0, 1, 0}, "glass")});
    brittle::WorldBudget budget;
    budget.breaking = breaking;
    return brittle::World::create(engine_test::device(), *brittle::contentsOf(scene, {}, nullptr), *brittle::settingsOf(scene),
                                  budget);
}

// 20,480 triangles: budgets follow the largest surface that breaks.
TEST(BreakingBudgets, AFineMeshBreaksWithoutBudgetsOfItsOwn) {
    BodyDescription bumpy = ball({0, 1.2, 0}, "glass");
    bumpy.shape.kind = brittle::ShapeKind::Mesh;
    bumpy.shape.file = "builtin:bumpy:5";
    bumpy.shape.cells.sites = 1;
    bumpy.velocity = {0, -6, 0};
    const auto world = worldOf(sceneOf({bumpy}));
    const double mass = massOf(presentBodies(*world));
    const auto events = stepUntilItBreaks(*world, 30);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].made.y, 0u);
    EXPECT_GT(events[0].made.x, 50u);
    EXPECT_NEAR(massOf(presentBodies(*world)), mass, 1e-5 * mass);
}

// An even share of 800 fragments is 8 for each of a hundred balls.
TEST(BreakingBudgets, OneOfManyBodiesTakesAtMostEightEvenShares) {
    std::vector<BodyDescription> balls;
    for (int k = 0; k < 100; ++k) {
        balls.push_back(ball({0.5 * (k % 10), 0.2, 0.5 * (k / 10)}, "glass"));
        balls.back().velocity = {0, -9, 0};
    }
    brittle::WorldBudget budget;
    budget.breaking.fragments = 800;
    const auto world = worldOf(sceneOf(balls), budget);
    step(*world, 12);
    const auto told = world->breaks();
    ASSERT_TRUE(told);
    EXPECT_EQ(told->events.size(), 100u);
    uint32_t most = 0;
    for (const gpu::BreakEvent& event : told->events) {
        EXPECT_EQ(event.made.y, 0u);
        most = std::max(most, event.made.x);
    }
    EXPECT_LE(most, 64u);
    EXPECT_GT(most, 32u);
}

TEST(BreakingBudgets, BudgetsOfOneFragmentAreRefused) {
    for (const auto budget_of : {&brittle::BreakingBudget::most_fragments, &brittle::BreakingBudget::step_sites}) {
        brittle::BreakingBudget budget;
        budget.*budget_of = 1;
        const auto refused = tryWorldOfABall(budget);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, engine::ErrorCode::BadInput);
        EXPECT_NE(refused.error().message.find("a budget of one"), std::string::npos) << refused.error().message;
    }
}

TEST(BreakingBudgets, MoreFragmentsThanPoolsHoldAreRefusedByName) {
    EXPECT_TRUE(tryWorldOfABall({.fragments = 16384}));
    const auto refused = tryWorldOfABall({.fragments = 40'000});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, engine::ErrorCode::Capacity);
    EXPECT_NE(refused.error().message.find("a budget of 40000 fragments"), std::string::npos) << refused.error().message;
    EXPECT_NE(refused.error().message.find("at most"), std::string::npos);
}

// Glass that breaks when it lands, and balls of something else that land on another part of the floor, one after the other.
SceneDescription landing() {
    std::vector<BodyDescription> bodies = {ball({0, 2, 0}, "glass")};
    for (int k = 1; k <= 12; ++k)
        bodies.push_back(ball({2.0 * k, 1.9 + 0.02 * k, 0}, ""));
    return sceneOf(std::move(bodies));
}

TEST(BreakingBudgets, AStepThatThereIsNoRoomForBreaksNothing) {
    const auto ample = worldOf(landing());
    std::vector<uint32_t> contacts; // of each step until it breaks
    while (ample->counts()->broken == 0 && contacts.size() < 60) {
        step(*ample);
        contacts.push_back(ample->counts()->contacts);
    }
    const auto steps = static_cast<uint32_t>(contacts.size()) - 1;
    ASSERT_GT(contacts[steps], contacts[steps - 1]) << "something else has to land in that step";
    const auto small = worldOf(landing(), {.contacts = contacts[steps] - 1});
    step(*small, steps);
    const auto before = small->hash();
    const auto lacking = small->step();
    ASSERT_FALSE(lacking);
    EXPECT_EQ(lacking.error().code, engine::ErrorCode::Capacity);
    EXPECT_EQ(*small->hash(), *before);
    EXPECT_TRUE(small->breaks()->events.empty());
    const auto state = small->save();
    const auto other = worldOf(landing());
    ASSERT_TRUE(other->restore(*state));
    step(*other);
    EXPECT_EQ(*other->hash(), *ample->hash());
    step(*other, 30);
    step(*ample, 30);
    EXPECT_EQ(*other->hash(), *ample->hash());
}

} // namespace
