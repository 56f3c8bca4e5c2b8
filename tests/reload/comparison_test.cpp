// Two worlds on one device, one of them stepped by a kernel with a planted fault: the comparison names that kernel.
#include "engine/reload/glsl_compiler.h"
#include "modules/brittle/comparison/recorded_step.h"
#include "modules/brittle/comparison/world_comparison.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"
#include "tests/reload/source_folder.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace engine;
using namespace reload_test;
using brittle::BufferDifference;
using brittle::StepComparison;
using brittle::World;

namespace {

struct Fault {
    const char *folder, *kernel;
    std::string what, by;
};

std::unique_ptr<World> tower() {
    const auto scene = brittle::makeBuiltinScene("stack_10");
    EXPECT_TRUE(scene) << scene.error().message;
    return breaking_scenes::worldOf(*scene);
}

std::unique_ptr<World> breakingBall() { return breaking_scenes::worldOf(breaking_scenes::shot(30, "glass")); }

brittle::ComparedWorld compared(World& world) { return {engine_test::device(), world}; }

class Comparison : public SourceFolder {
protected:
    void SetUp() override {
        SourceFolder::SetUp();
        fs::copy(fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv", folder(), fs::copy_options::recursive);
    }
    void plant(World& world, const Fault& fault) const {
        const std::string file = std::string(fault.folder) + "/" + fault.kernel + ".comp";
        write(file, replaced(read(file), fault.what, fault.by));
        const CompiledKernel made = compileGlsl({fault.kernel, folder() / file, {}}, {folder()});
        ASSERT_TRUE(made.good()) << textOf(made.diagnostics);
        auto replacement = world.kernels().prepare(fault.kernel, std::make_shared<const std::vector<uint32_t>>(made.words));
        ASSERT_TRUE(replacement) << replacement.error().message;
        std::vector<KernelReplacement> replacements;
        replacements.push_back(std::move(*replacement));
        ASSERT_TRUE(world.kernels().adopt(replacements));
        ASSERT_TRUE(world.kernelsChanged());
    }
    // The finding of the step after `steps` steps.
    std::optional<BufferDifference> findingOf(const Fault& fault, uint32_t steps) const {
        const auto sound = tower(), faulty = tower();
        EXPECT_TRUE(sound->step(steps));
        const auto state = sound->save();
        plant(*faulty, fault);
        const auto compared_step = brittle::compareStep(compared(*sound), compared(*faulty), *state, *state);
        EXPECT_TRUE(compared_step) << compared_step.error().message;
        if (!compared_step || compared_step->finding() == nullptr) return std::nullopt;
        return *compared_step->finding();
    }
    static void expectFinding(const std::optional<BufferDifference>& finding, const std::string& stage,
                              const std::string& kernel, const std::string& slot, const std::string& member) {
        ASSERT_TRUE(finding);
        EXPECT_EQ(finding->stage, stage);
        EXPECT_EQ(finding->kernel_a, kernel);
        EXPECT_EQ(finding->kernel_b, kernel);
        EXPECT_EQ(finding->slot, slot);
        ASSERT_TRUE(finding->first);
        EXPECT_EQ(finding->first->type, "float");
        EXPECT_NE(finding->first->member.find(member), std::string::npos) << finding->first->member;
        EXPECT_GT(finding->differing, 0u);
    }
};

const Fault kFaultOfEnd = {"solver", "end_step", "bodies[b].offset.xyz + moved",
                           "bodies[b].offset.xyz + 1.01 * moved"};

} // namespace

TEST_F(Comparison, NamesAFaultOfTheBroadPhase) {
    const auto finding =
        findingOf({"solver", "bound_pieces", "high_ahead + way) + margin", "high_ahead + way) + 3.0 * margin"}, 3);
    expectFinding(finding, "boxes", "bound_pieces", "box_high", "box_high[");
}

TEST_F(Comparison, NamesAFaultOfTheNarrowPhase) {
    const auto finding = findingOf({"narrow_phase", "build_manifolds", "vec4(turned(pair.turn, found.axis.xyz), 0.0)",
                                    "vec4(1.01 * turned(pair.turn, found.axis.xyz), 0.0)"},
                                   0); // all points are new
    expectFinding(finding, "narrow_phase", "build_manifolds", "manifolds", ".normal.");
}

TEST_F(Comparison, NamesAFaultOfTheSolver) {
    const auto finding = findingOf({"solver", "prepare_contacts", "inverseOf(yield_))", "1.01 * inverseOf(yield_))"}, 3);
    expectFinding(finding, "solve", "prepare_contacts", "solver_contacts", "solver_contacts[");
}

TEST_F(Comparison, NamesAFaultAtTheEndOfTheStepWithBothValues) {
    const auto finding = findingOf(kFaultOfEnd, 1);
    expectFinding(finding, "end", "end_step", "bodies", ".offset.");
    EXPECT_NE(finding->first->a, finding->first->b);
    EXPECT_NEAR(std::stod(finding->first->a), std::stod(finding->first->b), 0.01);
    EXPECT_EQ(finding->first->element_a, finding->first->element_b);
}

TEST_F(Comparison, FindsTheStepAndTheKernelOfAFaultInBreaking) {
    const auto sound = breakingBall(), faulty = breakingBall();
    plant(*faulty, {"breaking", "pay_cracks", "push(own, -impulse * n);", "push(own, -0.5 * impulse * n);"});
    const auto found = brittle::compareWorlds(compared(*sound), compared(*faulty), {.steps = 60});
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->first_difference && found->traced && found->body);
    EXPECT_EQ(found->traced->step, *found->first_difference);
    EXPECT_EQ(found->steps, *found->first_difference);
    ASSERT_NE(found->traced->comparison.finding(), nullptr);
    expectFinding(*found->traced->comparison.finding(), "rooms", "pay_cracks", "bodies", ".velocity.");
    EXPECT_GT(found->motion.linear_velocity, 0);
}

TEST_F(Comparison, GoesOnAfterTheFirstDifferenceAndMeasuresTheMotion) {
    const auto sound = tower(), faulty = tower();
    plant(*faulty, kFaultOfEnd);
    const auto found = brittle::compareWorlds(compared(*sound), compared(*faulty), {.steps = 20, .whole = true});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->steps, 20u);
    ASSERT_TRUE(found->first_difference && found->traced);
    EXPECT_LT(*found->first_difference, 20u);
    ASSERT_NE(found->traced->comparison.finding(), nullptr);
    EXPECT_EQ(found->traced->comparison.finding()->kernel_a, "end_step");
    EXPECT_GT(found->motion.position_m, 0);
}

TEST_F(Comparison, NamesTheKernelAgainstARecordedStep) {
    const auto sound = tower(), faulty = tower();
    ASSERT_TRUE(sound->step(3));
    const auto state = sound->save();
    const auto recorded = brittle::recordStep(compared(*sound), 4, *state);
    ASSERT_TRUE(recorded) << recorded.error().message;
    const auto same = brittle::compareWithRecorded(compared(*faulty), *recorded);
    ASSERT_TRUE(same) << same.error().message;
    EXPECT_EQ(same->finding(), nullptr);
    EXPECT_EQ(same->aligned, recorded->passes.size());
    plant(*faulty, kFaultOfEnd);
    const auto other = brittle::compareWithRecorded(compared(*faulty), *recorded);
    ASSERT_TRUE(other) << other.error().message;
    ASSERT_NE(other->finding(), nullptr);
    expectFinding(*other->finding(), "end", "end_step", "bodies", ".offset.");
}
