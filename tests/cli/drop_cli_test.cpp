// brittle shatter --drop as its users meet it: the fragments begin as the model and end on the ground.
#include "tests/reference/motion_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace {

using support::fileBytes;
using support::Outcome;
using support::runProgram;

class DropCli : public support::FolderTest {
protected:
    static Outcome shatter(std::vector<std::string> arguments, const std::vector<std::string>& environment = {}) {
        arguments.insert(arguments.begin(), {"shatter", "builtin:ring", "--sites", "20"});
        return runProgram("brittle", arguments, environment);
    }
    void expectRefused(std::vector<std::string> arguments, const std::string& holds) const {
        const Outcome run = shatter(std::move(arguments));
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder()));
    }
};

reference::Triangles allAt(const reference::MotionFile& file, size_t time) {
    reference::Triangles all;
    for (const reference::MovingBody& body : file.bodies)
        for (const auto* side : {&body.outer, &body.inner}) {
            const reference::Triangles moved = reference::placed(*side, body, time);
            all.insert(all.end(), moved.begin(), moved.end());
        }
    return all;
}

// What brittle shatter says of the model.
double volumeOf(const nlohmann::json& report) { return report["model"]["volume"].get<double>(); }

TEST_F(DropCli, BeginsAsTheModelAndEndsOnTheGround) {
    const Outcome run = shatter({"-o", path("fall.glb"), "--drop", "0.4", "--seconds", "2", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    const reference::MotionFile file = reference::readMotionFile(path("fall.glb"));
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    ASSERT_EQ(file.bodies.size(), report["fragments"].get<size_t>() + 1);
    const reference::Triangles first = allAt(file, 0), last = allAt(file, file.times.size() - 1);
    EXPECT_NEAR(reference::volumeOf(first), volumeOf(report), 1e-5 * volumeOf(report));
    const double ground = file.body("ground").places[0][1];
    EXPECT_NEAR(reference::boundsOf(first).lower[1] - ground, 0.4, 1e-5);
    EXPECT_NEAR(reference::boundsOf(last).lower[1], ground, 0.02);
    EXPECT_LT(reference::boundsOf(last).upper[1], reference::boundsOf(first).upper[1] - 0.4);
    EXPECT_NEAR(report["motion"]["seconds"].get<double>(), 2, 1.0 / 60);
}

TEST_F(DropCli, FallsHalfOfItsHeightUnlessToldOtherwise) {
    ASSERT_EQ(shatter({"-o", path("fall.glb"), "--seconds", "0", "--drop"}).exit_code, 0);
    const reference::MotionFile file = reference::readMotionFile(path("fall.glb"));
    const reference::Bounds bounds = reference::boundsOf(allAt(file, 0));
    EXPECT_NEAR(bounds.lower[1] - file.body("ground").places[0][1], (bounds.upper[1] - bounds.lower[1]) / 2, 1e-5);
}

TEST_F(DropCli, FallsTheSameWhateverTheThreadsAndWorkgroups) {
    const auto fall = [&](std::vector<std::string> more, const std::vector<std::string>& environment) {
        more.insert(more.end(), {"-o", path("fall.glb"), "--seconds", "0.7", "--drop", "0.1"});
        const Outcome run = shatter(more, environment);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return fileBytes(path("fall.glb"));
    };
    const std::string usual = fall({}, {});
    ASSERT_FALSE(usual.empty());
    EXPECT_TRUE(fall({}, {"LP_NUM_THREADS=1"}) == usual);
    EXPECT_TRUE(fall({"--group-size", "16"}, {}) == usual);
    EXPECT_FALSE(fall({"--seed", "2"}, {}) == usual);
}

TEST_F(DropCli, IsDrawnToo) {
    const Outcome run = shatter({"-o", path("fall.png"), "--seconds", "0.2", "--drop"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(fileBytes(path("fall.png")).substr(1, 3), "PNG");
}

TEST_F(DropCli, RefusesWhatIsWrongInOneLine) {
    expectRefused({"-o", path("a.glb"), "--drop", "-1"}, "no height");
    expectRefused({"-o", path("a.glb"), "--drop", "nan"}, "no height");
    expectRefused({"-o", path("a.glb"), "--seconds", "2"}, "--seconds requires --drop");
    expectRefused({"-o", path("a.glb"), "--collider", "none", "--drop"}, "needs colliders");
    expectRefused({"-o", path("a.obj"), "--drop"}, ".glb, .png and .mp4");
    expectRefused({"-o", path("a.png"), "--picture", path("a.png"), "--drop"}, "a file each");
}

} // namespace
