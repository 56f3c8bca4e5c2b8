// Brittle and another module in one program, as the engine's registry runs them, and their kernels edited meanwhile.
#include "engine/frame.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/register_module.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/engine/loaded/tick_module.h"
#include "tests/engine/test_device.h"
#include "tests/reload/following.h"

#include <gtest/gtest.h>

using namespace engine;
using namespace reload_test;

namespace {

class ModuleReload : public SourceFolder {
protected:
    void SetUp() override {
        SourceFolder::SetUp();
        ASSERT_TRUE(registry_.add(brittle::makeBrittleModule()));
        const auto loaded = registry_.load(fs::path(BRITTLE_MODULE_DIR) / "tick_module.so");
        ASSERT_TRUE(loaded) << loaded.error().message;
        ASSERT_TRUE(registry_.start(engine_test::device()));
        loop_.emplace(engine_test::device(), registry_, 1.0 / 60);
        scene_ = *brittle::makeBuiltinScene("stack_10");
    }
    void TearDown() override {
        loop_.reset();
        SourceFolder::TearDown();
    }
    brittle::World* addStack() {
        auto* worlds = static_cast<brittle::Worlds*>(registry_.find("brittle")->service(brittle::kWorldsService));
        auto world = worlds->add(*brittle::contentsOf(scene_, {}, nullptr), *brittle::settingsOf(scene_));
        EXPECT_TRUE(world) << world.error().message;
        return world ? *world : nullptr;
    }
    void runFrames(int frames) {
        for (int k = 0; k < frames; ++k) {
            const auto report = loop_->step();
            ASSERT_TRUE(report) << report.error().message;
        }
    }
    uint32_t ticks() {
        const auto read = static_cast<tick::Clock*>(registry_.find("tick")->service(tick::kClock))->read();
        EXPECT_TRUE(read);
        return read ? (*read)[0] : 0;
    }
    uint64_t hashAfter(uint32_t steps) {
        const auto world = brittle::World::create(engine_test::device(), *brittle::contentsOf(scene_, {}, nullptr),
                                                  *brittle::settingsOf(scene_));
        EXPECT_TRUE((*world)->step(steps));
        return *(*world)->hash();
    }
    ModuleRegistry& registry() { return registry_; }
    const brittle::SceneDescription& scene() const { return scene_; }

private:
    ModuleRegistry registry_;
    std::optional<FrameLoop> loop_;
    brittle::SceneDescription scene_;
};

} // namespace

TEST_F(ModuleReload, FramesStepWorldsAsTheyStepThemselves) {
    ASSERT_NEAR(scene().step.dt, 1.0 / 60, 1e-12);
    brittle::World* world = addStack();
    ASSERT_NE(world, nullptr);
    runFrames(12);
    EXPECT_EQ(*world->hash(), hashAfter(12));
    brittle::World* second = addStack(); // another one, later
    runFrames(8);
    EXPECT_EQ(*world->hash(), hashAfter(20));
    EXPECT_EQ(*second->hash(), hashAfter(8));
    EXPECT_EQ(ticks(), 20u);
}

TEST_F(ModuleReload, AWorldThatHasNotStartedIsRefused) {
    const auto module = brittle::makeBrittleModule();
    auto* worlds = static_cast<brittle::Worlds*>(module->service(brittle::kWorldsService));
    EXPECT_FALSE(worlds->add(*brittle::contentsOf(scene(), {}, nullptr)));
    EXPECT_EQ(module->service("brittle.worlds/2"), nullptr);
}

TEST_F(ModuleReload, KernelsOfAModuleThatWasLoadedAreReloaded) {
    const fs::path source = fs::path(BRITTLE_SOURCE_DIR) / "tests/engine/loaded/tick.comp";
    write("tick.comp", readFile(source));
    Module& module = *registry().find("tick");
    auto started = ShaderReloader::start(engine_test::device(), {.folder = folder(), .modules = module.kernels()});
    ASSERT_TRUE(started) << started.error().message;
    Following reloader(std::move(*started));
    for (KernelLibrary* library : module.libraries())
        reloader->attach(*library);
    reloader.next(Kind::Unchanged, "tick");
    runFrames(3);
    write("tick.comp", replaced(readFile(source), "ticks[0] += 1u", "ticks[0] += 100u"));
    reloader.next(Kind::Reloaded, "tick");
    ASSERT_TRUE(module.onKernelsChanged());
    runFrames(2);
    EXPECT_EQ(ticks(), 203u);
}

TEST_F(ModuleReload, KernelsOfBrittleAreReloadedByTheSameContract) {
    fs::copy(fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv", folder(), fs::copy_options::recursive);
    brittle::World* world = addStack();
    Module& module = *registry().find("brittle");
    auto started = ShaderReloader::start(engine_test::device(), {.folder = folder(), .modules = module.kernels()});
    ASSERT_TRUE(started) << started.error().message;
    Following reloader(std::move(*started));
    for (KernelLibrary* library : module.libraries())
        reloader->attach(*library);
    reloader.next(Kind::Unchanged, "end_step");
    runFrames(3);
    write("solver/end_step.comp", replaced(read("solver/end_step.comp"), "(bodies[b].sector.w & BODY_HANGS) != 0",
                                           "(bodies[b].sector.w & BODY_HANGS) == BODY_HANGS"));
    reloader.next(Kind::Reloaded, "end_step");
    ASSERT_TRUE(module.onKernelsChanged());
    runFrames(4);
    EXPECT_EQ(*world->hash(), hashAfter(7));
}
