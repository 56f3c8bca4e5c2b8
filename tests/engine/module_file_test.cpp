#include "engine/frame.h"
#include "engine/module_file.h"
#include "tests/engine/loaded/tick_module.h"
#include "tests/engine/test_device.h"
#include "tests/support/folder_test.h"
#include "tests/support/folders.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace engine;
using namespace engine_test;

namespace {

std::filesystem::path built(const std::string& name) {
    return support::folderFrom("BRITTLE_TEST_MODULES", BRITTLE_MODULE_DIR) / (name + ".so");
}

// Runs a few frames of whatever is in a registry and asks the module "tick" for its count.
void expectTicks(ModuleRegistry& registry) {
    const auto started = registry.start(device());
    ASSERT_TRUE(started) << started.error().message;
    FrameLoop loop(device(), registry, 0.25);
    for (int k = 0; k < 5; ++k) {
        const auto report = loop.step();
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->timings.back().name, "tick");
    }
    Module* module = registry.find("tick");
    ASSERT_NE(module, nullptr);
    EXPECT_EQ(module->service("tick.clock/2"), nullptr);
    auto* clock = static_cast<tick::Clock*>(module->service(tick::kClock));
    ASSERT_NE(clock, nullptr);
    const auto ticks = clock->read();
    ASSERT_TRUE(ticks) << ticks.error().message;
    EXPECT_EQ(*ticks, (std::array<uint32_t, 2>{5, 1250}));
}

std::string errorOf(const std::filesystem::path& file) {
    ModuleRegistry registry;
    const auto loaded = registry.load(file);
    EXPECT_FALSE(loaded);
    EXPECT_TRUE(registry.modules().empty());
    if (loaded) return "";
    EXPECT_EQ(loaded.error().code, ErrorCode::BadInput);
    EXPECT_TRUE(loaded.error().message.starts_with(file.string() + ": ")) << loaded.error().message;
    return loaded.error().message;
}

void expectPart(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << text; }

using BadModuleFiles = support::FolderTest;

} // namespace

TEST(ModuleFiles, RunAsLinkedModulesDo) {
    ModuleRegistry linked, loaded;
    ASSERT_TRUE(linked.add(tick::makeTick()));
    expectTicks(linked);
    const auto added = loaded.load(built("tick_module"));
    ASSERT_TRUE(added) << added.error().message;
    EXPECT_EQ(loaded.modules()[0]->info().name, "tick");
    EXPECT_EQ(loaded.modules()[0]->info().version, "1.0");
    expectTicks(loaded);
}

TEST(ModuleFiles, ShowTheirKernels) {
    ModuleRegistry registry;
    ASSERT_TRUE(registry.load(built("tick_module")));
    Module& module = *registry.modules()[0];
    ASSERT_EQ(module.kernels().size(), 1u);
    EXPECT_EQ(module.kernels()[0].name, "tick");
    EXPECT_EQ(module.kernels()[0].file, "tick.comp");
    ASSERT_TRUE(registry.start(device()));
    ASSERT_EQ(module.libraries().size(), 1u);
    EXPECT_TRUE(module.libraries()[0]->has("tick"));
}

TEST(ModuleFiles, AreLoadedAgainAfterTheyWereGivenUp) {
    for (int k = 0; k < 3; ++k) {
        ModuleRegistry registry;
        ASSERT_TRUE(registry.load(built("tick_module")));
        expectTicks(registry);
    }
}

TEST(ModuleFiles, HaveNamesOfTheirOwn) {
    ModuleRegistry registry;
    ASSERT_TRUE(registry.add(tick::makeTick()));
    const auto again = registry.load(built("tick_module"));
    ASSERT_FALSE(again);
    expectPart(again.error().message, "two modules are named \"tick\"");
    EXPECT_EQ(registry.modules().size(), 1u);
}

TEST_F(BadModuleFiles, AreNotThereOrNoLibraries) {
    expectPart(errorOf(path("absent.so")), "there is no such file");
    expectPart(errorOf(folder()), "there is no such file");
    std::ofstream(path("text.so")) << "not a library";
    expectPart(errorOf(path("text.so")), "is no shared library");
    std::ofstream(path("empty.so")).flush();
    expectPart(errorOf(path("empty.so")), "is no shared library");
    std::ofstream(path("cut.so"), std::ios::binary) << "\x7f"
                                                       "ELF and no more";
    expectPart(errorOf(path("cut.so")), "cannot be loaded");
}

TEST_F(BadModuleFiles, HoldNoModuleOfThisEngine) {
    expectPart(errorOf(built("bad_name")), "it has no object engine_module");
    expectPart(errorOf(built("bad_interface")), "is for interface 99 of the engine, this one has 1");
    expectPart(errorOf(built("bad_build")), "against other headers");
    expectPart(errorOf(built("bad_create")), "made no module");
}

TEST_F(BadModuleFiles, LackKernels) {
    ModuleRegistry registry;
    ASSERT_TRUE(registry.add(tick::makeTick()));
    ASSERT_TRUE(registry.load(built("bad_kernels")));
    const auto started = registry.start(device());
    ASSERT_FALSE(started);
    EXPECT_EQ(started.error().code, ErrorCode::BadInput);
    expectPart(started.error().message, "module \"lacking\": has no kernel \"absent_kernel\"");
}

TEST_F(BadModuleFiles, ThrowInAFrame) {
    ModuleRegistry registry;
    ASSERT_TRUE(registry.load(built("bad_frame")));
    ASSERT_TRUE(registry.start(device()));
    FrameLoop loop(device(), registry, 0.25);
    const auto report = loop.step();
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::Internal);
    expectPart(report.error().message, "module \"lacking\": threw: thrown in a frame");
}
