// The program shader_reload, from outside.
#include "engine/reload/kernel_times.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "tests/module/breaking_scenes.h"
#include "tests/reload/following.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

using namespace reload_test;

namespace {

class ReloadTool : public SourceFolder {
protected:
    static support::Outcome run(const std::vector<std::string>& arguments) {
        return support::runProgram("shader_reload", arguments);
    }
    static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
    void copyKernels() const {
        fs::copy(fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv", folder(), fs::copy_options::recursive);
    }
    // By the times of a kernel that is edited without a change to what it does: they are told sixty steps on.
    void expectSteps(support::RunningProgram& tool) const {
        const std::string name = "solver/move_bodies.comp";
        write(name, replaced(read(name), "velocity.w != 0.0", "velocity.w != 0.0 && b != 0xfffffff0u"));
        EXPECT_TRUE(tool.says("  move_bodies: ", kPatience));
    }
    const std::string kSound = "#version 450\nlayout(local_size_x = 64) in;\nvoid main() {}\n";
};

std::string hashAfter(const std::string& scene, uint32_t steps) {
    const auto world = breaking_scenes::worldOf(*brittle::makeBuiltinScene(scene));
    EXPECT_TRUE(world->step(steps));
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(*world->hash()));
    return digits;
}

} // namespace

TEST_F(ReloadTool, ChecksAFolderOnceAndEndsWithACode) {
    write("one.comp", kSound);
    write("below/two.comp", kSound);
    const support::Outcome sound = run({"--once", folder().string()});
    EXPECT_EQ(sound.exit_code, 0) << sound.err;
    EXPECT_TRUE(has(sound.out, "2 kernels")) << sound.out;
    EXPECT_TRUE(has(sound.out, "2 sound, 0 refused")) << sound.out;
    write("below/two.comp", kSound + "uint f() { return missing; }\n");
    const support::Outcome wrong = run({"--once", folder().string()});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_TRUE(wrong.err.starts_with(path("below/two.comp") + ":4:19: error: 'missing'")) << wrong.err;
    EXPECT_TRUE(has(wrong.out, "1 sound, 1 refused")) << wrong.out;
}

TEST_F(ReloadTool, SaysWhatIsNoFolderAndTellsManyAlikeOnce) {
    for (const std::string& place : {path("nowhere"), std::string("/dev/null")})
        for (const auto& arguments : std::vector<std::vector<std::string>>{{"--once", place}, {place}}) {
            const support::Outcome outcome = run(arguments);
            EXPECT_EQ(outcome.exit_code, 2);
            EXPECT_TRUE(has(outcome.err, place + ": is no folder")) << outcome.err;
        }
    EXPECT_TRUE(has(run({"--scene", "/dev/null", folder().string()}).err, "its name has to end in .toml"));
    fs::create_directories(folder() / "solver");
    fs::copy(fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv/solver/end_step.comp", folder() / "solver");
    const support::Outcome outcome =
        run({"--once", "-I", std::string(BRITTLE_SOURCE_DIR) + "/shaders-spirv", folder().string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(has(outcome.err, " more: cannot be read")) << outcome.err;
    EXPECT_LT(std::ranges::count(outcome.err, '\n'), 12) << outcome.err;
}

TEST_F(ReloadTool, ComparesInterfacesWithThoseThatWereBuilt) {
    fs::create_directories(folder() / "primitives");
    const fs::path root = fs::path(BRITTLE_SOURCE_DIR) / "shaders-spirv";
    write("primitives/clear_words.comp", replaced(readFile(root / "primitives/clear_words.comp"), "WRITES(0", "UPDATES(0"));
    const support::Outcome outcome = run({"--once", "-I", root.string(), folder().string()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(has(outcome.err, "kernel \"clear_words\": binding 0")) << outcome.err;
}

TEST_F(ReloadTool, ExplainsBadUsage) {
    for (const auto& arguments : std::vector<std::vector<std::string>>{{},
                                                                       {path("nowhere")},
                                                                       {"--once", path("nowhere")},
                                                                       {"--once", "--window", folder().string()},
                                                                       {"--frobnicate", "."}}) {
        const support::Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("shader_reload: ")) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
}

TEST_F(ReloadTool, SaysThatThereIsNoScreenForAWindow) {
    copyKernels();
    const support::Outcome outcome =
        support::runProgram("shader_reload", {"--window", folder().string()}, {"DISPLAY=", "WAYLAND_DISPLAY="});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(has(outcome.err, "window")) << outcome.err;
}

TEST_F(ReloadTool, StepsASceneOnWhileItIsEdited) {
    copyKernels();
    const std::string name = "solver/end_step.comp", source = read(name);
    support::RunningProgram tool("shader_reload", {"--scene", "stack_10", "--steps", "1000000", folder().string()});
    ASSERT_TRUE(tool.says("watching", kPatience));
    write(name, replaced(source, "uint b = flatIndex();", "uint b = ;"));
    EXPECT_TRUE(tool.says("kept the last good end_step", kPatience));
    write(name, replaced(source, "(bodies[b].sector.w & BODY_HANGS) != 0", "(bodies[b].sector.w & BODY_HANGS) == BODY_HANGS"));
    EXPECT_TRUE(tool.says("reloaded end_step", kPatience));
    EXPECT_TRUE(tool.says("  end_step: ", kPatience)); // its times before and after
    tool.interrupt();
    const support::Outcome outcome = tool.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.err, path("solver/end_step.comp") + ":")) << outcome.err;
    const size_t ending = outcome.out.find(" steps, state ");
    ASSERT_NE(ending, std::string::npos) << outcome.out;
    const std::string steps = outcome.out.substr(outcome.out.rfind('\n', ending) + 1);
    const auto count = static_cast<uint32_t>(std::stoul(steps));
    EXPECT_EQ(steps, std::to_string(count) + " steps, state " + hashAfter("stack_10", count) + "\n");
}

// Sound kernels, of which one spoils the bodies and one makes every step fail.
TEST_F(ReloadTool, BeginsASceneAnewThatAnEditHasSpoiled) {
    copyKernels();
    const std::string name = "solver/end_step.comp", source = read(name);
    const std::string begin = "uint b = flatIndex();";
    support::RunningProgram tool("shader_reload", {"--scene", "stack_10", folder().string()});
    ASSERT_TRUE(tool.says("watching", kPatience));
    write(name,
          replaced(source, begin,
                   begin + "\n    if (b < counts[COUNT_BODIES]) bodies[b].offset.xyz = vec3(uintBitsToFloat(0x7fc00000u));"));
    EXPECT_TRUE(tool.says("reloaded end_step", kPatience));
    write(name, replaced(source, begin, begin + "\n    counts[STATUS_FAILED] = 1u;"));
    EXPECT_TRUE(tool.says("failed, after reloads of end_step (the latest first): ", kPatience));
    EXPECT_TRUE(tool.says("; the scene begins anew\n", kPatience));
    write(name, source);
    expectSteps(tool);
    tool.interrupt();
    const support::Outcome outcome = tool.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(has(outcome.out, " steps, state ")) << outcome.out;
}

// Steps that are made and never counted would be made for ever.
TEST_F(ReloadTool, BeginsASceneAnewWhoseStepsAreNotCounted) {
    copyKernels();
    const std::string name = "solver/end_step.comp", source = read(name);
    support::RunningProgram tool("shader_reload", {"--scene", "bounce", folder().string()});
    ASSERT_TRUE(tool.says("watching", kPatience));
    write(name, replaced(source, "if (b == 0u) steps[STEPS_MADE]++;", ""));
    EXPECT_TRUE(tool.says("neither counted nor called failed", kPatience));
    write(name, replaced(source, "if (b == 0u) steps[STEPS_MADE]++;", "if (b == 0u) steps[STEPS_BODIES] = 0xfffffff0u;"));
    EXPECT_TRUE(tool.says("the device counts 4294967280 bodies", kPatience));
    write(name, source);
    expectSteps(tool);
    tool.interrupt();
    EXPECT_EQ(tool.wait().exit_code, 0);
}

TEST_F(ReloadTool, EndsWellWhereNoStepCanBeMade) {
    copyKernels();
    const std::string name = "solver/end_step.comp", source = read(name);
    write(name, replaced(source, "if (b == 0u) steps[STEPS_MADE]++;", ""));
    {
        support::RunningProgram tool("shader_reload", {"--scene", "bounce", folder().string()});
        ASSERT_TRUE(tool.says("the scene begins anew", kPatience));
        tool.interrupt();
        const support::Outcome outcome = tool.wait();
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(has(outcome.out, "the last of them failed")) << outcome.out;
    }
    const support::Outcome outcome = run({"--scene", "bounce", "--steps", "6", folder().string()});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_TRUE(has(outcome.err, "the scene cannot be stepped by these kernels")) << outcome.err;
}

TEST(KernelTimes, AreMediansBeforeAndAfter) {
    engine::KernelTimes times(3);
    const auto frame = [&](double ms) {
        const engine::Timing timing[] = {{"cut", ms, 1}, {"other", 1, 1}};
        times.add(timing);
    };
    for (const double ms : {9, 4, 5, 6}) // the first is forgotten
        frame(ms);
    const std::string names[] = {"cut"};
    times.reloaded(names);
    frame(2);
    frame(8);
    EXPECT_TRUE(times.takeChanges().empty());
    frame(3);
    const auto changes = times.takeChanges();
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].name, "cut");
    EXPECT_EQ(changes[0].before_ms, 5);
    EXPECT_EQ(changes[0].after_ms, 3);
    EXPECT_TRUE(times.takeChanges().empty());
}
