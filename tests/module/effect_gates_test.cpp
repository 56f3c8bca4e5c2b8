// What an effect that is off costs: no bytes, no passes, and no code that would touch its memory.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/module/effect_cost.h"
#include "tests/support/frozen_shader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

using brittle::Effect;
using brittle::EffectSet;
using brittle::Pass;
using brittle::PlannedBuffer;
using brittle::StepPlan;
using brittle::StepSettings;
using brittle::World;
using support::FrozenShader;

constexpr Effect kSwitches[] = {Effect::Gravity, Effect::Contacts, Effect::Friction, Effect::Restitution,
                                Effect::Ccd,     Effect::Sleeping, Effect::Drag};
constexpr uint32_t kLanes = 64;

StepSettings allOn() {
    StepSettings settings;
    settings.sleeping = settings.drag = true;
    return settings;
}

StepSettings without(Effect effect) {
    StepSettings settings = allOn();
    switch (effect) {
    case Effect::Gravity: settings.gravity = {0, 0, 0}; break;
    case Effect::Contacts: settings.contacts = false; break;
    case Effect::Friction: settings.friction = false; break;
    case Effect::Restitution: settings.restitution = false; break;
    case Effect::Ccd: settings.ccd = false; break;
    case Effect::Sleeping: settings.sleeping = false; break;
    default: settings.drag = false;
    }
    return settings;
}

std::unique_ptr<World> worldOf(const StepSettings& settings, uint32_t hulls = 12) {
    brittle::SceneDescription scene = *brittle::makeBuiltinScene("hull_pile_" + std::to_string(hulls));
    for (brittle::BodyDescription& body : scene.bodies)
        body.surface.restitution = 0.4;
    const auto contents = brittle::contentsOf(scene, ".", nullptr);
    EXPECT_TRUE(contents);
    auto world = World::create(engine_test::device(), *contents, settings);
    EXPECT_TRUE(world);
    return std::move(*world);
}

StepPlan planOf(const StepSettings& settings) {
    auto plan = worldOf(settings)->plan();
    EXPECT_TRUE(plan);
    return *plan;
}

FrozenShader frozen(const std::string& kernel, const StepSettings& settings) {
    return {kernel, brittle::kernelConstants(settings, kLanes)};
}

bool has(const StepPlan& plan, const std::string& kernel) {
    return std::ranges::count(plan.kernels, kernel) != 0 || std::ranges::count(plan.passes, kernel, &Pass::kernel) != 0;
}

// ---- buffers --------------------------------------------------------------------------------------------------------------

TEST(EffectGates, AnEffectThatIsOffHasNoBytes) {
    for (const Effect off : kSwitches) {
        const StepPlan plan = planOf(without(off));
        EXPECT_FALSE(plan.effects.has(off)) << brittle::nameOf(off);
        EXPECT_EQ(plan.bytesOf(off), 0u) << brittle::nameOf(off);
        for (const PlannedBuffer& buffer : plan.buffers)
            if (buffer.asked_by && !plan.effects.has(*buffer.asked_by)) {
                EXPECT_EQ(buffer.bytes, 0u) << buffer.name;
            }
    }
}

TEST(EffectGates, WhatIsOnHasItsBuffers) {
    const StepPlan plan = planOf(allOn());
    for (const Effect effect : {Effect::Contacts, Effect::Ccd, Effect::Sleeping})
        EXPECT_GT(plan.bytesOf(effect), 0u) << brittle::nameOf(effect);
    for (const PlannedBuffer& buffer : plan.buffers)
        EXPECT_EQ(buffer.bytes > 0, !buffer.asked_by || plan.effects.has(*buffer.asked_by)) << buffer.name;
}

TEST(EffectGates, BytesAddUpToWhatTheWorldHasTakenFromThePool) {
    const engine::Device& device = engine_test::device();
    if (device.gpuAssistedValidation()) GTEST_SKIP() << "every range is a buffer of its own there";
    for (const StepSettings& settings : {allOn(), without(Effect::Contacts), without(Effect::Sleeping)}) {
        const VkDeviceSize before = engine_test::device().memory().takenBytes();
        const auto world = worldOf(settings);
        const VkDeviceSize taken = engine_test::device().memory().takenBytes() - before;
        const auto plan = world->plan();
        ASSERT_TRUE(plan);
        EXPECT_GE(taken, plan->bytes());
        EXPECT_LE(taken, plan->bytes() + 256 * plan->buffers.size()) << "what views and buffers are rounded up by";
    }
}

// ---- passes ---------------------------------------------------------------------------------------------------------------

TEST(EffectGates, WithoutContactsAStepIsFivePasses) {
    const StepPlan plan = planOf(without(Effect::Contacts));
    EXPECT_EQ(plan.kernels, (std::vector<std::string>{"begin_step", "end_step", "move_bodies", "open_step", "push_bodies"}));
    const auto dispatches = std::ranges::count_if(plan.passes, &Pass::isDispatch);
    EXPECT_EQ(dispatches, 3 + 2 * 4) << "two in each of four substeps";
}

struct Owned {
    Effect effect;
    std::vector<std::string> kernels;
};

TEST(EffectGates, AnEffectThatIsOffHasNoPassesAndLoadsNoKernels) {
    const StepPlan all = planOf(allOn());
    for (const auto& [effect, kernels] : std::vector<Owned>{
             {Effect::Restitution, {"bounce_islands"}},
             {Effect::Ccd, {"hold_back"}},
             {Effect::Sleeping, {"time_islands", "wake_contacts", "lull_bodies", "time_rest"}},
             {Effect::Contacts,
              {"bound_pieces", "pair_few", "recall_contacts", "find_axes", "build_manifolds", "remember_contacts",
               "keep_pair_count", "prepare_contacts", "keep_impulses", "hold_back", "join_islands",
               "settle_islands", "color_contacts", "order_islands", "bounce_islands"}}}) {
        const StepPlan plan = planOf(without(effect));
        for (const std::string& kernel : kernels) {
            const bool wide = engine_test::device().subgroupSize() >= 32 && (has(all, kernel + "_wide"));
            EXPECT_TRUE(has(all, wide ? kernel + "_wide" : kernel)) << kernel;
            EXPECT_FALSE(has(plan, kernel) || has(plan, kernel + "_wide")) << kernel;
        }
    }
}

TEST(EffectGates, EffectsThatAreNoPassesCostNone) {
    const StepPlan all = planOf(allOn());
    for (const Effect off : {Effect::Gravity, Effect::Friction, Effect::Drag}) {
        const StepPlan plan = planOf(without(off));
        EXPECT_EQ(plan.kernels, all.kernels);
        EXPECT_EQ(plan.passes.size(), all.passes.size());
        EXPECT_EQ(plan.bytes(), all.bytes());
    }
}

TEST(EffectGates, KernelsThatAreLoadedAreThoseOfThePasses) {
    for (const Effect off : kSwitches) {
        const StepPlan plan = planOf(without(off));
        std::set<std::string> used;
        for (const Pass& pass : plan.passes)
            if (pass.isDispatch()) used.insert(pass.kernel);
        EXPECT_EQ(std::set<std::string>(plan.kernels.begin(), plan.kernels.end()), used) << brittle::nameOf(off);
    }
}

// ---- code -----------------------------------------------------------------------------------------------------------------

// Whatever is off, specialized kernels do not even look at a binding that nobody asked for.
TEST(EffectGates, NoKernelTouchesTheDummy) {
    for (const Effect off : kSwitches) {
        const StepPlan plan = planOf(without(off));
        std::set<std::string> seen;
        for (const Pass& pass : plan.passes)
            for (const brittle::PassBuffer& buffer : pass.buffers) {
                if (buffer.buffer != "dummy" || !seen.insert(pass.kernel + "/" + buffer.slot).second) continue;
                ASSERT_TRUE(pass.isDispatch()) << brittle::nameOf(off);
                const FrozenShader shader = frozen(pass.kernel, without(off));
                EXPECT_FALSE(shader.stores(buffer.slot)) << pass.kernel << " " << buffer.slot;
                EXPECT_FALSE(shader.loads(buffer.slot)) << pass.kernel << " " << buffer.slot;
            }
        EXPECT_EQ(seen.empty(), off != Effect::Contacts && off != Effect::Ccd) << brittle::nameOf(off);
    }
}

struct FrictionStore {
    const char* kernel;
    const char* binding;
    const char* impulses;
};

constexpr FrictionStore kFrictionStores[] = {{"prepare_contacts", "solver_contacts", "SolverContact.rub"},
                                             {"solve_contacts", "solver_contacts", "SolverContact.rub"},
                                             {"solve_rest", "solver_contacts", "SolverContact.rub"},
                                             {"solve_rest_wide", "solver_contacts", "SolverContact.rub"},
                                             {"solve_islands", "solver_contacts", "SolverContact.rub"},
                                             {"solve_islands_wide", "solver_contacts", "SolverContact.rub"},
                                             {"keep_impulses", "memory", "ContactMemory.rub"},
                                             {"remember_contacts", "memory", "ContactMemory.rub"}};

TEST(EffectGates, WithoutFrictionNothingIsStoredToItsImpulses) {
    for (const auto& [kernel, binding, impulses] : kFrictionStores) {
        EXPECT_TRUE(frozen(kernel, allOn()).stores(binding, impulses)) << kernel;
        EXPECT_FALSE(frozen(kernel, without(Effect::Friction)).stores(binding, impulses)) << kernel;
        EXPECT_TRUE(frozen(kernel, without(Effect::Friction)).stores(binding)) << kernel << " has other things to do";
    }
}

TEST(EffectGates, WithoutCcdNobodyIsFastAndNobodyIsHeldBack) {
    const FrozenShader on = frozen("begin_step", allOn()), off = frozen("begin_step", without(Effect::Ccd));
    EXPECT_TRUE(on.stores("shares") && on.stores("counts"));
    EXPECT_FALSE(off.stores("shares") || off.stores("counts"));
    EXPECT_TRUE(frozen("end_step", allOn()).loads("shares"));
    EXPECT_FALSE(frozen("end_step", without(Effect::Ccd)).loads("shares"));
}

TEST(EffectGates, WithoutDragItsCodeIsGone) {
    const StepSettings off = without(Effect::Drag);
    EXPECT_LT(frozen("begin_step", off).instructions(), frozen("begin_step", allOn()).instructions());
    StepSettings dense = off;
    dense.air_density = 1000;
    EXPECT_EQ(brittle::kernelConstants(dense, kLanes).back().value, 0u) << "however dense the air that is not there";
}

// ---- plans ----------------------------------------------------------------------------------------------------------------

TEST(EffectGates, APlanIsTheSameTwiceAndNamesEveryBuffer) {
    const auto world = worldOf(allOn());
    const auto first = world->plan();
    ASSERT_TRUE(world->step(3));
    const auto second = world->plan();
    ASSERT_TRUE(first && second);
    EXPECT_TRUE(*first == *second);
    EXPECT_TRUE(*first == planOf(allOn()));
    std::set<std::string> names;
    for (const PlannedBuffer& buffer : first->buffers)
        EXPECT_TRUE(!buffer.name.empty() && names.insert(buffer.name).second) << buffer.name;
    for (const Pass& pass : first->passes)
        for (const brittle::PassBuffer& buffer : pass.buffers)
            EXPECT_TRUE(names.contains(buffer.buffer)) << pass.kernel << " " << buffer.slot;
}

TEST(EffectGates, MakingAPlanAndMeasuringLeaveTheWorldAsItIs) {
    const auto looked_at = worldOf(allOn()), plain = worldOf(allOn());
    ASSERT_TRUE(looked_at->plan());
    const auto us = looked_at->measure(7);
    ASSERT_TRUE(us);
    ASSERT_TRUE(looked_at->step(3));
    ASSERT_TRUE(plain->step(10));
    EXPECT_EQ(*looked_at->hash(), *plain->hash());
    const auto plan = looked_at->plan();
    ASSERT_TRUE(plan);
    if (!us->empty()) {
        EXPECT_EQ(us->size(), static_cast<size_t>(std::ranges::count_if(plan->passes, &Pass::isDispatch)));
    }
}

// What each effect costs in a pile of 60, which is told and not judged.
TEST(EffectGates, TheCostOfEachEffectIsTold) {
    const effect_cost::Cost on = effect_cost::costOf(*worldOf(allOn(), 60), 30);
    for (const Effect effect : kSwitches) {
        const effect_cost::Cost off = effect_cost::costOf(*worldOf(without(effect), 60), 30);
        EXPECT_LE(off.bytes, on.bytes);
        effect_cost::tell(effect, on, off);
    }
}

} // namespace
