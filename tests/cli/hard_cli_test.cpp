// brittle hard as its users meet it: its rows, what it leaves in a folder, what it refuses.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

using nlohmann::json;
using support::fileBytes;
using support::Outcome;
using support::runProgram;

const std::string kStored = std::string(BRITTLE_SOURCE_DIR) + "/tests/cli/accuracy_results.json";

class HardCli : public support::FolderTest {
protected:
    static Outcome hard(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "hard");
        return runProgram("brittle", arguments);
    }
    json results() const { return json::parse(fileBytes(path("page/results.json"))); }
};

size_t linesOf(const std::string& text) { return static_cast<size_t>(std::count(text.begin(), text.end(), '\n')); }

TEST_F(HardCli, ListsMoreThanAHundredCasesWithoutRunningAny) {
    const Outcome run = hard({"--list"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_GT(linesOf(run.out), 100u);
    for (const char* name : {"sites: lattice, cubic, 16", "ball broken eight times over", "mesh with a hole", "full pools of faces and triangles",
                             "hard_20_pile_1000", "hard_05_stack_40 (long)"})
        EXPECT_NE(run.out.find(name), std::string::npos) << name;
}

TEST_F(HardCli, ShowsARowForEveryPrecisionAndLeavesThePage) {
    const Outcome run = hard({"--only", "sites on a cube's corners", "-o", path("page")});
    EXPECT_EQ(run.exit_code, 0) << "less than exact promises nothing: " << run.err;
    EXPECT_NE(run.out.find("3 cases: 1 pass"), std::string::npos) << run.out;
    const json cases = results()["hard"];
    ASSERT_EQ(cases.size(), 3u);
    EXPECT_EQ(cases[0]["setting"], "exact");
    EXPECT_EQ(cases[0]["has_passed"], true);
    EXPECT_GT(cases[0]["exact_tests"], 0);
    EXPECT_GT(cases[0]["ms"], 0);
    EXPECT_EQ(cases[2]["setting"], "fast");
    EXPECT_EQ(cases[2]["has_passed"], false) << "everything ties here";
    EXPECT_TRUE(fileBytes(path("page/report.html")).starts_with("<!doctype html>"));
}

TEST_F(HardCli, AddsToWhatAccuracyHasMeasured) {
    std::filesystem::create_directories(folder() / "page");
    std::filesystem::copy_file(kStored, folder() / "page" / "results.json");
    const json before = results();
    const Outcome run = hard({"--only", "mesh with a fin", "-o", path("page")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const json after = results();
    EXPECT_EQ(after["measurements"].size(), before["measurements"].size());
    ASSERT_EQ(after["hard"].size(), 1u);
    EXPECT_EQ(after["hard"][0]["name"], "mesh with a fin");
}

// A build without Bullet says what is missing.
TEST_F(HardCli, JudgesBulletByTheSameChecks) {
    const Outcome run = hard({"--only", "hard_38_cradle_10mm", "--bullet", "-o", path("page")});
    if (run.exit_code != 0) {
        EXPECT_EQ(run.exit_code, 4);
        EXPECT_NE(run.err.find("install libbullet-dev"), std::string::npos) << run.err;
        return;
    }
    EXPECT_NE(run.out.find("\n1 cases: 1 pass"), std::string::npos) << "rows of Bullet are none of ours: " << run.out;
    EXPECT_NE(run.out.find("Bullet: 1 cases by the same checks: 1 pass"), std::string::npos) << run.out;
    const json cases = results()["hard"];
    ASSERT_EQ(cases.size(), 2u);
    EXPECT_EQ(cases[0]["setting"], "as it is");
    EXPECT_EQ(cases[1]["setting"], "Bullet");
    EXPECT_EQ(cases[1]["name"], "hard_38_cradle_10mm");
    EXPECT_EQ(cases[1]["has_passed"], true);
}

TEST_F(HardCli, BulletNeitherFailsTheCommandNorPassesWhatItCannotBeJudgedBy) {
    const Outcome failing = hard({"--only", "hard_36_slide_wedge", "--bullet"});
    if (failing.exit_code == 4) GTEST_SKIP() << failing.err;
    EXPECT_EQ(failing.exit_code, 0) << failing.err;
    EXPECT_NE(failing.out.find("Bullet: 1 cases by the same checks: 0 pass"), std::string::npos) << failing.out;
    const Outcome left_out = hard({"--only", "hard_22_far_body", "--bullet"});
    EXPECT_EQ(left_out.exit_code, 0) << left_out.err;
    EXPECT_NE(left_out.out.find("Bullet        left out: "), std::string::npos) << left_out.out;
    EXPECT_EQ(left_out.out.find("Bullet: "), std::string::npos) << left_out.out;
}

TEST_F(HardCli, MovesCasesOfMotionAtAnotherSizeAndLeavesOutTheOthers) {
    const Outcome run = hard({"--scale", "0.01", "--only", "hard_38_cradle_10mm", "-o", path("page")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1 cases: 1 pass"), std::string::npos) << run.out;
    EXPECT_EQ(results()["hard"][0]["setting"], "x0.01");
    const Outcome scene = hard({"--scale", "100", "--only", "hard_22_far_body"});
    EXPECT_NE(scene.out.find("x100          left out: its checks ask for more"), std::string::npos) << scene.out;
    const Outcome mesh = hard({"--scale", "100", "--only", "mesh with a fin"});
    EXPECT_NE(mesh.out.find("left out: it moves no scene"), std::string::npos) << mesh.out;
}

TEST_F(HardCli, JudgesBulletAtAnotherSizeToo) {
    const Outcome run = hard({"--scale", "100", "--only", "hard_38_cradle_10mm", "--bullet", "-o", path("page")});
    if (run.exit_code == 4) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("\n1 cases: 1 pass"), std::string::npos) << run.out;
    EXPECT_EQ(results()["hard"][1]["setting"], "Bullet x100");
}

TEST_F(HardCli, RefusesWhatIsNoScale) {
    for (const char* bad : {"", "abc", "nan", "inf", "0", "-1", "0.0009", "1001", "0.01x"}) {
        const Outcome run = hard({std::string("--scale=") + bad});
        EXPECT_EQ(run.exit_code, 2) << bad << ": " << run.err;
        EXPECT_NE(run.err.find("scale"), std::string::npos) << bad << ": " << run.err;
    }
}

TEST_F(HardCli, RefusesWhatThereIsNot) {
    const auto expectRefused = [](const Outcome& run, const std::string& holds, int exit_code = 2) {
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        EXPECT_EQ(linesOf(run.err), 1u) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
    };
    expectRefused(hard({"--only", "no such case"}), "brittle hard --list");
    expectRefused(hard({"--list", "--only", "no such case"}), "brittle hard --list");
    expectRefused(hard({"--only", ""}), "empty name");
    expectRefused(hard({"--device", "no such device"}), "no such device", 4);
    expectRefused(hard({"-o", "/proc/no"}), "/proc/no");
    expectRefused(hard({"--device", "no such device", "-o", path("page")}), "no such device", 4);
    expectRefused(hard({"--only", "no such case", "-o", path("deep/page")}), "brittle hard --list");
    EXPECT_TRUE(std::filesystem::is_empty(folder())) << "folders go again where nothing comes into them";
    std::filesystem::create_directories(folder() / "page");
    std::ofstream(path("page/results.json")) << "{";
    expectRefused(hard({"-o", path("page")}), "results.json");
    EXPECT_EQ(fileBytes(path("page/results.json")), "{") << "what is there stays";
}

TEST_F(HardCli, ListsOnlyTheCasesThatAreAskedFor) {
    const Outcome run = hard({"--list", "--only", "hard_38_cradle"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, "hard_38_cradle_touching\nhard_38_cradle_1mm\nhard_38_cradle_10mm\n");
}

} // namespace
