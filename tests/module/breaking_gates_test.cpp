// What breaking costs where it is off, or where nothing breaks; and that who only watches changes nothing.
#include "modules/brittle/dynamics/scene_settings.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"
#include "tests/module/effect_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

using namespace breaking_scenes;
using brittle::Effect, brittle::Pass, brittle::PlannedBuffer, brittle::SceneDescription, brittle::StepPlan;

constexpr Effect kSwitches[] = {Effect::ImpactFracture, Effect::Refracture, Effect::Events};

SceneDescription fall(std::vector<std::string> effects) {
    SceneDescription scene = sceneOf({ball({0, 2, 0}, "concrete"), ball({3, 0.1, 0}, "")});
    scene.effects = std::move(effects);
    return scene;
}

SceneDescription allOn() { return fall({"gravity", "contacts", "friction", "impact_fracture", "refracture", "events"}); }

SceneDescription without(Effect effect) {
    SceneDescription scene = allOn();
    std::erase(scene.effects, nameOf(effect));
    // Whoever needs what is off goes with it, and what it needs stays.
    if (effect == Effect::ImpactFracture) scene.effects = {"gravity", "contacts", "friction", "ccd"};
    return scene;
}

StepPlan planOf(const SceneDescription& scene) {
    const auto plan = worldOf(scene)->plan();
    EXPECT_TRUE(plan);
    return *plan;
}

std::set<std::string> kernelsOf(const StepPlan& plan) {
    std::set<std::string> kernels;
    for (const Pass& pass : plan.passes)
        if (pass.isDispatch()) kernels.insert(pass.kernel);
    return kernels;
}

TEST(BreakingGates, WhatIsOffHasNoBytes) {
    for (const Effect off : kSwitches) {
        const StepPlan plan = planOf(without(off));
        EXPECT_FALSE(plan.effects.has(off)) << nameOf(off);
        EXPECT_EQ(plan.bytesOf(off), 0u) << nameOf(off);
    }
    const StepPlan on = planOf(allOn());
    EXPECT_GT(on.bytesOf(Effect::ImpactFracture), 1u << 20);
    EXPECT_GE(on.bytesOf(Effect::Events), BREAK_EVENTS * sizeof(gpu::BreakEvent) + IMPACT_EVENTS * sizeof(gpu::ImpactEvent));
}

TEST(BreakingGates, AWorldThatBreaksNothingIsThatOfBodiesThatCannotBreak) {
    SceneDescription sound = without(Effect::ImpactFracture);
    for (brittle::BodyDescription& body : sound.bodies)
        body.material.clear();
    const StepPlan plan = planOf(without(Effect::ImpactFracture)), of_sound = planOf(sound);
    EXPECT_EQ(plan.passes, of_sound.passes);
    EXPECT_EQ(plan.kernels, of_sound.kernels);
    EXPECT_EQ(plan.bytes(), of_sound.bytes());
}

TEST(BreakingGates, ThePassesOfAnEffectAreThereWithItAlone) {
    const std::set<std::string> all = kernelsOf(planOf(allOn())), whole = kernelsOf(planOf(without(Effect::ImpactFracture)));
    for (const char* kernel :
         {"find_blows", "advance_turning", "judge_turning", "admit_breaking", "cut_cells", "clip_triangles", "emit",
          "pay_cracks", "adopt_hulls", "retire_bodies", "take_ranges", "return_ranges"}) {
        const bool wide = engine_test::device().subgroupSize() >= 32 && all.contains(std::string(kernel) + "_wide");
        EXPECT_TRUE(all.contains(wide ? std::string(kernel) + "_wide" : kernel)) << kernel;
        EXPECT_FALSE(whole.contains(kernel) || whole.contains(std::string(kernel) + "_wide")) << kernel;
    }
    std::set<std::string> silent = kernelsOf(planOf(without(Effect::Events)));
    for (const char* kernel : {"tell_breaks", "find_impacts", "tell_impacts"})
        EXPECT_TRUE(silent.insert(kernel).second) << kernel;
    EXPECT_EQ(silent, all);
}

TEST(BreakingGates, WhetherFragmentsBreakIsAPushConstantAndCostsNothing) {
    const StepPlan on = planOf(allOn()), off = planOf(without(Effect::Refracture));
    EXPECT_EQ(on.passes, off.passes);
    EXPECT_EQ(on.kernels, off.kernels);
    EXPECT_EQ(on.bytes(), off.bytes());
}

TEST(BreakingGates, ThePlanNamesEveryBufferOfEveryPassAndLoadsNoOtherKernels) {
    const StepPlan plan = planOf(allOn());
    std::set<std::string> names;
    for (const PlannedBuffer& buffer : plan.buffers) {
        EXPECT_TRUE(!buffer.name.empty() && names.insert(buffer.name).second) << buffer.name;
        EXPECT_TRUE(!buffer.asked_by || plan.effects.has(*buffer.asked_by) || buffer.bytes == 0) << buffer.name;
    }
    for (const Pass& pass : plan.passes) {
        EXPECT_TRUE(pass.counted_by.empty() ==
                    (pass.size == brittle::PassSize::Lanes || pass.size == brittle::PassSize::Groups || !pass.isDispatch()))
            << pass.kernel;
        EXPECT_FALSE(pass.counted_by.starts_with("count ")) << pass.kernel << ": " << pass.counted_by;
        for (const brittle::PassBuffer& buffer : pass.buffers)
            EXPECT_TRUE(names.contains(buffer.buffer)) << pass.kernel << " " << buffer.slot;
    }
    EXPECT_EQ(std::set<std::string>(plan.kernels.begin(), plan.kernels.end()), kernelsOf(plan));
}

TEST(BreakingGates, BytesAddUpToWhatTheWorldHasTakenFromThePool) {
    engine::Device& device = engine_test::device();
    if (device.gpuAssistedValidation()) GTEST_SKIP() << "every range is a buffer of its own there";
    const VkDeviceSize before = device.memory().takenBytes();
    const auto world = worldOf(allOn());
    const VkDeviceSize taken = device.memory().takenBytes() - before;
    const auto plan = world->plan();
    ASSERT_TRUE(plan);
    EXPECT_GE(taken, plan->bytes());
    EXPECT_LE(taken, plan->bytes() + 256 * plan->buffers.size()) << "what views and buffers are rounded up by";
}

TEST(BreakingGates, WhereNothingBreaksEveryPassOverWhatBreaksHasNoGroups) {
    const auto world = worldOf(allOn());
    step(*world, 3);
    const auto plan = world->plan();
    const auto counts = world->counts();
    ASSERT_TRUE(plan && counts);
    EXPECT_EQ(counts->broken, 0u);
    EXPECT_EQ(counts->breaking_groups, 0u);
    ASSERT_FALSE(stepUntilItBreaks(*world, 60).empty());
    EXPECT_GT(world->counts()->breaking_groups, 100u);
}

// Who listens hears all of it, and moves nothing.
TEST(BreakingGates, ThatTheHostIsToldOfBreaksChangesNoBit) {
    const auto told = worldOf(allOn()), silent = worldOf(without(Effect::Events));
    for (uint32_t k = 0; k < 9; ++k) {
        step(*told, 10);
        step(*silent, 10);
        EXPECT_EQ(*told->hash(), *silent->hash()) << k;
    }
    EXPECT_FALSE(told->breaks()->events.empty());
    EXPECT_TRUE(silent->breaks()->events.empty());
    EXPECT_GT(silent->counts()->broken, 0u);
}

TEST(BreakingGates, NothingIsReadBackWhileAWorldGoesOn) {
    const auto going_on = worldOf(allOn()), asked = worldOf(allOn());
    const uint64_t before = engine_test::device().readBackBytes();
    ASSERT_TRUE(going_on->advance(90));
    EXPECT_EQ(engine_test::device().readBackBytes(), before);
    for (uint32_t k = 0; k < 90; ++k)
        step(*asked);
    EXPECT_GT(engine_test::device().readBackBytes(), before);
    EXPECT_EQ(*going_on->hash(), *asked->hash());
    EXPECT_GT(going_on->counts()->broken, 0u);
    EXPECT_EQ(going_on->breaks()->events.size(), asked->breaks()->events.size());
}

// In a step in which nothing breaks, which is told and not judged.
TEST(BreakingGates, TheCostOfEachEffectIsTold) {
    const effect_cost::Cost on = effect_cost::costOf(*worldOf(allOn()), 15);
    for (const Effect effect : kSwitches) {
        const effect_cost::Cost off = effect_cost::costOf(*worldOf(without(effect)), 15);
        EXPECT_LE(off.bytes, on.bytes);
        effect_cost::tell(effect, on, off);
    }
}

} // namespace
