// Effects: what a scene lists, what that needs, and what air does.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/effects/effect_set.h"
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using brittle::AddedEffect;
using brittle::BodyDefinition;
using brittle::Effect;
using brittle::EffectSet;
using brittle::resolve;
using brittle::StepSettings;
using brittle::World;

TEST(SmallEffects, WhatIsNeededComesAlongAndSaysWhoCalledForIt) {
    const auto friction = resolve(EffectSet{Effect::Friction});
    EXPECT_EQ(friction.set, (EffectSet{Effect::Friction, Effect::Contacts, Effect::Ccd}));
    EXPECT_EQ(friction.added,
              (std::vector<AddedEffect>{{Effect::Contacts, Effect::Friction}, {Effect::Ccd, Effect::Contacts}}));
    const auto dust = resolve(EffectSet{Effect::Dust, Effect::Contacts});
    EXPECT_EQ(dust.added, (std::vector<AddedEffect>{{Effect::Ccd, Effect::Contacts}, {Effect::ImpactFracture, Effect::Dust}}));
    const auto stress = resolve(EffectSet{Effect::Stress});
    EXPECT_EQ(stress.set, (EffectSet{Effect::Stress, Effect::Bonds, Effect::Contacts, Effect::Ccd}));
}

TEST(SmallEffects, WhatNeedsNothingBringsNothing) {
    for (const Effect effect : {Effect::Gravity, Effect::Drag, Effect::Events}) {
        EXPECT_TRUE(resolve(EffectSet{effect}).added.empty()) << brittle::nameOf(effect);
        EXPECT_EQ(resolve(EffectSet{effect}).set, EffectSet{effect});
    }
    EXPECT_EQ(resolve(EffectSet()).set, EffectSet());
}

TEST(SmallEffects, EveryEffectHasANameASentenceAndAClosedSet) {
    for (const std::string_view name : brittle::kEffectNames) {
        const auto effect = brittle::effectOf(name);
        ASSERT_TRUE(effect) << name;
        EXPECT_EQ(brittle::nameOf(*effect), name);
        EXPECT_TRUE(brittle::factsOf(*effect).sentence.ends_with('.')) << name;
        const EffectSet closed = resolve(EffectSet{*effect}).set;
        EXPECT_TRUE(resolve(closed).added.empty()) << name;
    }
    EXPECT_FALSE(brittle::effectOf("frction"));
}

TEST(SmallEffects, WhatHasAPlaceAndIsNotThereYetIsRefused) {
    for (const std::string name : {"bonds", "stress"}) {
        const auto refused = resolve(std::vector<std::string>{"gravity", name});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().message, "the effect '" + name + "' has a place and is not there yet; leave it out");
        brittle::SceneDescription scene = *brittle::makeBuiltinScene("stack_2");
        scene.effects.push_back(name);
        const auto checked = brittle::checkScene(scene);
        ASSERT_FALSE(checked);
        EXPECT_EQ(checked.error().message, refused.error().message);
    }
    EXPECT_FALSE(resolve(std::vector<std::string>{"frction"}));
}

TEST(SmallEffects, ASceneHasWhatItListsAndWhatThatNeeds) {
    brittle::SceneDescription scene = *brittle::makeBuiltinScene("stack_2");
    scene.effects = {"restitution"};
    const auto settings = brittle::settingsOf(scene);
    ASSERT_TRUE(settings);
    EXPECT_EQ(brittle::effectsOf(*settings), (EffectSet{Effect::Restitution, Effect::Contacts, Effect::Ccd}));
    scene.effects = {"gravity", "drag"};
    EXPECT_EQ(brittle::effectsOf(*brittle::settingsOf(scene)), (EffectSet{Effect::Gravity, Effect::Drag}));
}

TEST(SmallEffects, WithoutContactsNothingThatNeedsThemIsThere) {
    StepSettings settings;
    settings.contacts = false;
    settings.sleeping = true;
    EXPECT_EQ(brittle::effectsOf(settings), EffectSet{Effect::Gravity});
}

// ---- drag -----------------------------------------------------------------------------------------------------------------

// A plank of 2 m that flies and turns about its longest axis.
gpu::BodyState flownFor(uint32_t steps, const StepSettings& settings) {
    BodyDefinition plank = support::box({2, 0.4, 0.3}, {0, 0, 0});
    plank.velocity = {60, 0, 80};
    plank.spin = {40, 0, 0};
    brittle::WorldContents contents;
    EXPECT_TRUE(brittle::addBody(contents, plank));
    auto world = World::create(engine_test::device(), contents, settings);
    EXPECT_TRUE(world);
    EXPECT_TRUE((*world)->step(steps));
    return (*world)->bodies()->at(0);
}

StepSettings inAir(double density) {
    StepSettings settings;
    settings.gravity = {0, 0, 0};
    settings.contacts = false;
    settings.drag = true;
    settings.air_density = density;
    settings.drag_coefficient = 0.8;
    return settings;
}

// v' = -k |v| v has the solution 1 / v = 1 / v0 + k t.
TEST(World, AirSlowsABodyAsTheSolutionOfItsEquationHasIt) {
    const BodyDefinition plank = support::box({2, 0.4, 0.3}, {0, 0, 0});
    const double radius = std::sqrt(1 + 0.04 + 0.0225), strength = 0.5 * 30 * 0.8 * std::numbers::pi;
    const double k = strength * radius * radius / plank.mass;
    const auto body = flownFor(120, inAir(30));
    const double speed = 1 / (1 / 100.0 + 2 * k);
    EXPECT_NEAR(body.velocity.x, 0.6 * speed, 1e-4 * speed);
    EXPECT_NEAR(body.velocity.z, 0.8 * speed, 1e-4 * speed);
    const double inverse = (1 / plank.inertia[0] + 1 / plank.inertia[1] + 1 / plank.inertia[2]) / 3;
    const double spin = 1 / (1 / 40.0 + 2 * strength * std::pow(radius, 5) * inverse);
    EXPECT_NEAR(body.spin.x, spin, 1e-3 * spin);
    EXPECT_LT(spin, 20);
    EXPECT_NEAR(body.momentum.x, plank.inertia[0] * spin, 1e-3 * plank.inertia[0] * spin);
}

TEST(World, AirTurnsNoVelocityAroundHoweverDenseItIs) {
    StepSettings settings = inAir(1e4);
    settings.dt = 1;
    for (const uint32_t steps : {1u, 2u, 5u}) {
        const auto body = flownFor(steps, settings);
        EXPECT_GT(body.velocity.x, 0);
        EXPECT_LT(body.velocity.x, 1);
        EXPECT_GT(body.spin.x, 0);
        EXPECT_EQ(body.velocity.y, 0);
    }
}

TEST(World, WhatFallsInAirReachesTheSpeedAtWhichItCarriesTheWeight) {
    StepSettings settings = inAir(30);
    settings.gravity = {0, -9.81, 0};
    const BodyDefinition plank = support::box({2, 0.4, 0.3}, {0, 0, 0});
    const double k = 0.5 * 30 * 0.8 * std::numbers::pi * 1.0625 / plank.mass;
    const auto body = flownFor(1200, settings);
    EXPECT_NEAR(body.velocity.y, -std::sqrt(9.81 / k), 0.05 * std::sqrt(9.81 / k));
}

TEST(World, WithoutDragTheAirIsNothing) {
    StepSettings settings = inAir(1e4);
    settings.drag = false;
    const auto body = flownFor(60, settings);
    EXPECT_EQ(body.velocity.x, 60.0f);
    EXPECT_EQ(body.velocity.z, 80.0f);
    EXPECT_EQ(body.spin.x, 40.0f);
}

} // namespace
