// A stack that is rubbed, compared body by body with the same method in double precision.
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/support/scene_run.h"
#include "tests/support/stacked_boxes.h"

#include <gtest/gtest.h>

namespace {

using support::SceneRun;

void stepBoth(SceneRun& run, reference::RigidStack& stack, uint32_t steps) {
    run.step(steps);
    for (uint32_t k = 0; k < steps; ++k)
        stack.step();
}

// The points of the oracle are those of the first step. Of the world's, too, as long as it finds none anew.
void expectPointsKept(SceneRun& run, const reference::RigidStack& stack) {
    const auto counts = run.world().counts();
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->fresh, 0u);
    EXPECT_EQ(counts->contacts, stack.contacts().size());
    EXPECT_TRUE(stack.hardlyMoved());
}

// The stack of hard_30 only sinks; these are rubbed. For 80 steps: by then they lie still, and what rounding leaves of pushes
// is all that moves them (2e-5 of what gravity adds in a step, at step 120).
TEST(World, CubesThatSlideAndTwistMoveAsTheReferenceSays) {
    brittle::SceneDescription scene = *brittle::makeBuiltinScene("stack_3");
    scene.effects = {"gravity", "contacts", "friction"};
    scene.bodies[0].velocity = {0.05, 0, 0.1};
    scene.bodies[1].spin = {0, 0.1, 0};
    scene.bodies[2].velocity = {-0.1, 0, 0.05};
    SceneRun run(scene);
    const auto boxes = support::stackedBoxes(scene);
    ASSERT_TRUE(boxes);
    reference::RigidStack stack(*boxes, support::stackSettings(scene));
    for (const uint32_t steps : {1u, 9u, 70u}) {
        stepBoth(run, stack, steps);
        const support::StackDifference now = differenceOf(run, stack);
        EXPECT_LE(now.place, 1e-6) << "after another " << steps;
        EXPECT_LE(now.turn, 1e-6) << "after another " << steps;
        EXPECT_LE(now.velocity, 1e-5) << "after another " << steps;
        EXPECT_LE(now.spin, 1e-5) << "after another " << steps;
        if (steps == 1) {
            EXPECT_GT(run.furthestWay(), 1e-3) << "nothing slides";
        }
    }
    expectPointsKept(run, stack);
}

} // namespace
