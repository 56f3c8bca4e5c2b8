// The program on a device that lacks every optional feature: it does the same, or says what is missing.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

namespace {

using support::Outcome;
using support::runProgram;

const std::vector<std::string> kLesser = {"BRITTLE_DEVICE_WITHOUT=all"};

class LesserDevice : public support::FolderTest {
protected:
    std::string shattered(const std::vector<std::string>& options, const std::vector<std::string>& environment) {
        std::vector<std::string> arguments = {"shatter", "builtin:bumpy:3", "-o", path("out.glb")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome run = runProgram("brittle", arguments, environment);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return support::fileBytes(path("out.glb"));
    }
};

TEST_F(LesserDevice, ShattersIntoTheSameBytesWhicheverSearchFindsTheCells) {
    for (const char* search : {"grid", "linear", "sphere_tree"}) {
        const std::vector<std::string> options = {"--sites", "200", "--search", search};
        const std::string usual = shattered(options, {});
        EXPECT_FALSE(usual.empty());
        EXPECT_TRUE(usual == shattered(options, kLesser)) << search;
    }
}

TEST_F(LesserDevice, MovesAndBreaksBodiesToTheSameBits) {
    for (const char* scene : {"stack_10", BRITTLE_SOURCE_DIR "/modules/brittle/scene/examples/window_pane.toml"}) {
        const auto hash = [&](const std::vector<std::string>& environment) {
            const Outcome run = runProgram("brittle", {"simulate", scene, "--seconds", "1", "--state-hash"}, environment);
            EXPECT_EQ(run.exit_code, 0) << run.err;
            return run.out;
        };
        const std::string usual = hash({});
        EXPECT_EQ(usual.size(), 17u) << usual;
        EXPECT_EQ(hash(kLesser), usual) << scene;
    }
}

TEST_F(LesserDevice, RefusesDoublesInOneLineAndTakesExact) {
    const Outcome run = runProgram("brittle", {"shatter", "builtin:cube", "-o", path("cube.glb"), "--precision", "double"},
                                   {"BRITTLE_DEVICE_WITHOUT=doubles"});
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_NE(run.err.find("has no 64-bit floats in shaders, which precision double needs; use exact"), std::string::npos)
        << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("cube.glb")));
    EXPECT_FALSE(shattered({"--sites", "5"}, {"BRITTLE_DEVICE_WITHOUT=doubles"}).empty());
}

TEST_F(LesserDevice, WithAnUnknownFeatureIsBadInput) {
    const Outcome run =
        runProgram("brittle", {"shatter", "builtin:cube", "-o", path("cube.glb")}, {"BRITTLE_DEVICE_WITHOUT=wings"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("\"wings\" is no optional feature"), std::string::npos) << run.err;
}

} // namespace
