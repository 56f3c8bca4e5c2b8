// The broad phase of whole worlds, against all pairs of boxes.
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/reference/boxes.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using support::SceneRun;

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

} // namespace
