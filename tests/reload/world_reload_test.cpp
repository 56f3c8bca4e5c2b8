// Worlds that go on while the kernels that step them are edited.
#include "engine/reload/glsl_compiler.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"
#include "tests/reload/following.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace reload_test;
using brittle::World;

namespace {

brittle::SceneDescription builtin(const std::string& name) {
    auto scene = brittle::makeBuiltinScene(name);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? *scene : brittle::SceneDescription();
}

brittle::SceneDescription breakingBall() { return breaking_scenes::shot(30, "glass"); }

// Of as few kernels as there are.
brittle::SceneDescription fallingBall() {
    brittle::SceneDescription scene = breaking_scenes::sceneOf({breaking_scenes::ball({0, 1, 0}, "glass")}, false);
    scene.effects = {"gravity"};
    return scene;
}

uint64_t hashOf(World& world) {
    const auto hash = world.hash();
    EXPECT_TRUE(hash) << hash.error().message;
    return hash ? *hash : 0;
}

// One by one, as hosts do: where a world makes more room, it does so in the same step.
void run(World& world, uint32_t steps) {
    for (uint32_t k = 0; k < steps; ++k) {
        const auto done = world.step();
        ASSERT_TRUE(done) << done.error().message;
    }
}

// The project's kernels in a folder where they are edited while a world is stepped by them.
class WorldReload : public SourceFolder {
protected:
    void SetUp() override {
        SourceFolder::SetUp();
        fs::copy(fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv", folder(), fs::copy_options::recursive);
    }
    void TearDown() override {
        following_.reset();
        worlds_.clear();
        SourceFolder::TearDown();
    }
    // nullptr if it cannot be made. The fixture owns it, because it has to outlive what follows it.
    World* worldOf(const brittle::SceneDescription& scene) {
        return worlds_.emplace_back(breaking_scenes::worldOf(scene)).get();
    }
    void follow(World& world) {
        auto started = ShaderReloader::start(engine_test::device(), {.folder = folder()});
        ASSERT_TRUE(started) << started.error().message;
        following_.emplace(std::move(*started));
        (*following_)->attach(world.kernels());
        EXPECT_TRUE(following_->next(Kind::Unchanged).at_start); // the folder is as it was built
    }
    void edit(const std::string& name, const std::string& what, const std::string& by) {
        write(name, replaced(read(name), what, by));
    }
    // Steps on until an edit has been taken over, as a host does.
    ReloadEvent stepUntilTaken(World& world, const std::string& kernel, uint32_t& steps) {
        const auto begun = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - begun < kPatience) {
            for (ReloadEvent& event : (*following_)->swap()) {
                EXPECT_TRUE(event.kind == Kind::Reloaded || event.kind == Kind::Checked) << textOf(event);
                if (event.kind != Kind::Reloaded) continue;
                const auto recorded = world.kernelsChanged();
                EXPECT_TRUE(recorded) << recorded.error().message;
                EXPECT_NE(std::ranges::find(event.kernels, kernel), event.kernels.end());
                run(world, 1);
                ++steps;
                return event;
            }
            run(world, 1);
            ++steps;
        }
        ADD_FAILURE() << kernel << " was never taken over";
        return {};
    }
    Following& reloader() { return *following_; }

    // Another code that computes the same: a bit that is set, and the bits of an exponent.
    const std::string kHung = "bool hung = (bodies[b].sector.w & BODY_HANGS) != 0;";
    const std::string kHungAsWell = "bool hung = (bodies[b].sector.w & BODY_HANGS) == BODY_HANGS;";
    void expectSameMotion(const brittle::SceneDescription& scene, uint32_t most) {
        const auto followed = worldOf(scene), alone = worldOf(scene);
        ASSERT_TRUE(followed && alone);
        follow(*followed);
        uint32_t steps = 5;
        run(*followed, steps);
        edit("solver/end_step.comp", kHung, kHungAsWell);
        stepUntilTaken(*followed, "end_step", steps);
        edit("lib/take_up_spin.glsl", "floatBitsToUint(trace) & 0x7f800000u", "(floatBitsToUint(trace) >> 23u & 255u) << 23u");
        const ReloadEvent event = stepUntilTaken(*followed, "move_bodies", steps);
        EXPECT_GT(event.kernels.size(), 1u);
        const uint32_t more = std::max(most, steps + 5) - steps;
        run(*followed, more);
        steps += more;
        run(*alone, steps);
        EXPECT_EQ(hashOf(*followed), hashOf(*alone)) << "after " << steps << " steps";
    }

private:
    std::vector<std::unique_ptr<World>> worlds_;
    std::optional<Following> following_;
};

} // namespace

TEST_F(WorldReload, GoesOnBitForBitWhereEditsChangeNothing) { expectSameMotion(builtin("stack_10"), 60); }

TEST_F(WorldReload, GoesOnBitForBitWhereThingsBreak) { expectSameMotion(breakingBall(), 40); }

TEST_F(WorldReload, TakesOverWhatChangesTheMotionAndGoesBack) {
    const auto tower = worldOf(builtin("stack_10"));
    ASSERT_TRUE(tower);
    follow(*tower);
    run(*tower, 3);
    const auto saved = tower->save();
    ASSERT_TRUE(saved);
    run(*tower, 2);
    const uint64_t expected = hashOf(*tower);
    edit("lib/push_body.glsl", "m.velocity += falls;", "m.velocity -= falls;");
    uint32_t steps = 0;
    stepUntilTaken(*tower, "solve_islands", steps);
    ASSERT_TRUE(tower->restore(*saved));
    run(*tower, 2);
    EXPECT_NE(hashOf(*tower), expected); // it falls upward
    edit("lib/push_body.glsl", "m.velocity -= falls;", "m.velocity += falls;");
    stepUntilTaken(*tower, "solve_islands", steps);
    ASSERT_TRUE(tower->restore(*saved));
    run(*tower, 2);
    EXPECT_EQ(hashOf(*tower), expected);
}

TEST_F(WorldReload, StepsOnBitForBitWhileSourcesAreWrong) {
    const auto world = worldOf(builtin("stack_10")), alone = worldOf(builtin("stack_10"));
    ASSERT_TRUE(world && alone);
    follow(*world);
    edit("solver/end_step.comp", "uint b = flatIndex();", "uint b = ;");
    edit("solver/move_bodies.comp", "#version 450", "");
    fs::remove(folder() / "solver/push_bodies.comp");
    edit("solver/keep_impulses.comp", "READS(1", "UPDATES(1");
    uint32_t steps = 0;
    std::set<std::string> refused;
    const auto begun = std::chrono::steady_clock::now();
    while (!refused.contains("push_bodies") || !refused.contains("keep_impulses")) {
        ASSERT_LT(std::chrono::steady_clock::now() - begun, kPatience);
        for (const ReloadEvent& event : reloader()->swap()) {
            EXPECT_NE(event.kind, Kind::Reloaded);
            refused.insert(event.kernels.begin(), event.kernels.end());
        }
        run(*world, 1);
        ++steps;
    }
    run(*alone, steps);
    EXPECT_EQ(hashOf(*world), hashOf(*alone));
}

TEST_F(WorldReload, RecordsForCommandBuffersOfOthersAnew) {
    const auto world = worldOf(breakingBall()), alone = worldOf(breakingBall());
    ASSERT_TRUE(world && alone);
    const auto stepRecorded = [&](uint32_t steps) {
        for (uint32_t k = 0; k < steps; ++k) {
            Commands commands(engine_test::device());
            ASSERT_TRUE(commands.begin());
            ASSERT_TRUE(world->recordSteps(commands.handle()));
            engine_test::finish(commands);
            ASSERT_TRUE(world->counts()); // finds out what became of it
        }
    };
    stepRecorded(3);
    follow(*world);
    edit("solver/end_step.comp", kHung, kHungAsWell);
    reloader().next(Kind::Reloaded, "end_step");
    ASSERT_TRUE(world->kernelsChanged());
    stepRecorded(4);
    run(*alone, 7);
    EXPECT_EQ(hashOf(*world), hashOf(*alone));
}

TEST_F(WorldReload, DrawsByWhatWasReloaded) {
    const auto world = worldOf(breakingBall());
    ASSERT_TRUE(world);
    run(*world, 1);
    ASSERT_TRUE(world->drawBuffers());
    const auto generation = world->drawBuffers()->generation;
    follow(*world);
    edit("draw/write_draws.comp", "if (slot >= slots) return;", "if (slot + 1u > slots) return;");
    reloader().next(Kind::Reloaded, "write_draws");
    ASSERT_TRUE(world->kernelsChanged());
    EXPECT_EQ(world->drawBuffers()->generation, generation); // hosts keep the buffers they have
    EXPECT_TRUE(world->updateDraws({0, 0, 0}));
    Commands commands(engine_test::device());
    ASSERT_TRUE(commands.begin());
    EXPECT_TRUE(world->recordDraws(commands.handle(), {0, 0, 0}));
    engine_test::finish(commands);
}

TEST_F(WorldReload, TellsTheTimeOfEachKernel) {
    const auto world = worldOf(builtin("stack_10")), alone = worldOf(builtin("stack_10"));
    ASSERT_TRUE(world && alone);
    const auto tells = [&](const char* name) {
        const auto times = world->timings();
        EXPECT_TRUE(times);
        return times && std::ranges::count(*times, name, &Timing::name) != 0;
    };
    ASSERT_TRUE(world->timeKernels(true));
    run(*world, 4);
    EXPECT_TRUE(tells("end_step"));
    ASSERT_TRUE(world->timeKernels(false));
    run(*world, 2);
    EXPECT_FALSE(tells("end_step"));
    run(*alone, 6);
    EXPECT_EQ(hashOf(*world), hashOf(*alone));
}

// What runs under the validation layers and the sanitizers: a swap in a world's life.
TEST(SmallWorldReload, PutsAnotherVersionInPlaceBetweenSteps) {
    const auto world = breaking_scenes::worldOf(fallingBall()), alone = breaking_scenes::worldOf(fallingBall());
    ASSERT_TRUE(world && alone);
    run(*world, 3);
    const fs::path root = fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv";
    std::vector<KernelReplacement> replacements;
    for (const char* name : {"end_step", "begin_step"}) {
        const CompiledKernel made = compileGlsl({name, root / "solver" / (std::string(name) + ".comp"), {}}, {root});
        ASSERT_TRUE(made.good()) << textOf(made.diagnostics);
        auto replacement = world->kernels().prepare(name, std::make_shared<const std::vector<uint32_t>>(made.words));
        ASSERT_TRUE(replacement) << replacement.error().message;
        replacements.push_back(std::move(*replacement));
    }
    const std::weak_ptr<const Pipeline> old = (*world->kernels().get("end_step"))->pipeline;
    ASSERT_TRUE(world->kernels().adopt(replacements));
    EXPECT_FALSE(old.expired()); // recorded
    run(*world, 1);
    ASSERT_TRUE(world->kernelsChanged());
    EXPECT_TRUE(old.expired());
    run(*world, 3);
    run(*alone, 7);
    EXPECT_EQ(hashOf(*world), hashOf(*alone));
}
