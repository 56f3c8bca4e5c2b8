// brittle bench as its users meet it, at sizes that take a second: what the rows of rigid bodies say.
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using nlohmann::json;
using support::Outcome;
using support::runProgram;

json benchOf(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"bench", "--dynamics", "--rounds", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = runProgram("brittle", arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

// Bullet's are there where the build has it, and then they are of the same bodies.
void expectSaneEnd(const json& end) {
    EXPECT_GT(end["mean_height_m"].get<double>(), 0.2);
    EXPECT_LT(end["mean_height_m"].get<double>(), 3);
    EXPECT_LT(end["penetration_p99_mm"].get<double>(), 300);
    EXPECT_GE(end["penetration_most_mm"].get<double>(), end["penetration_p99_mm"].get<double>());
    EXPECT_GE(end["kinetic_energy_j"].get<double>(), 0);
    EXPECT_EQ(end["escaped"], 0);
}

TEST(BenchCli, SaysOfPilesWhatAStepTakesAndHowTheyLie) {
    const json report =
        benchOf({"--pile-counts", "8", "16", "--pile-steps", "25", "--box-counts", "300", "--pair-counts", "40"});
    ASSERT_TRUE(report.is_object());
    ASSERT_EQ(report["piles"].size(), 2u);
    for (const json& row : report["piles"]) {
        EXPECT_EQ(row["steps"], 25);
        EXPECT_GT(row["ms_per_step"].get<double>(), 0);
        EXPECT_GT(row["dispatches"].get<int>(), 10);
        expectSaneEnd(row["end"]);
        double shares = 0;
        for (const json& stage : row["stages"])
            shares += stage["share"].get<double>();
        EXPECT_NEAR(shares, 1, 1e-6);
        for (const json& peer : row["peers"]) {
            EXPECT_GT(peer["times_peer"].get<double>(), 0);
            expectSaneEnd(peer["end"]);
        }
    }
    EXPECT_TRUE(report["piles"][1].contains("growth"));
    EXPECT_FALSE(report["piles"][0].contains("growth"));
}

TEST(BenchCli, SaysOfBothPhasesWhatABoxAndAPairTake) {
    const json report =
        benchOf({"--pile-counts", "2", "--pile-steps", "1", "--box-counts", "100", "400", "--pair-counts", "64"});
    ASSERT_TRUE(report.is_object());
    const json& boxes = report["broad_phase"];
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_GT(boxes[0]["us_per_box"].get<double>(), 0);
    EXPECT_GT(boxes[1]["pairs"].get<int>(), boxes[0]["pairs"].get<int>());
    if (boxes[0].contains("bullet_pairs")) {
        EXPECT_GE(boxes[0]["bullet_pairs"].get<int>(), boxes[0]["pairs"].get<int>());
    }
    const json& pairs = report["narrow_phase"][0];
    EXPECT_EQ(pairs["pairs"], 64);
    EXPECT_GT(pairs["touching"].get<int>(), 32);
    EXPECT_GT(pairs["us_per_pair"].get<double>(), 0);
}

TEST(BenchCli, RefusesSizesThatAreNone) {
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{{"--pile-counts", "0"},
                                                                                       {"--pile-steps", "0"},
                                                                                       {"--box-counts", "300000"},
                                                                                       {"--pair-counts", "many"},
                                                                                       {"-o", "/no/such/folder/a.json"},
                                                                                       {"--cells"}}) {
        std::vector<std::string> arguments = {"bench", "--dynamics"};
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, 2) << wrong[0];
        EXPECT_TRUE(run.out.empty());
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

} // namespace
