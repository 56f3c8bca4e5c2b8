// brittle accuracy as its users meet it: what it refuses and how, and what it makes of results that are there already. A whole
// run is among the long tests.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

namespace {

using nlohmann::json;
using support::fileBytes;
using support::Outcome;
using support::runProgram;

const std::string kStored = std::string(BRITTLE_SOURCE_DIR) + "/tests/cli/accuracy_results.json";

class AccuracyCli : public support::FolderTest {
protected:
    static Outcome accuracy(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "accuracy");
        return runProgram("brittle", arguments);
    }
    // One line that says what and where, and nothing is left behind.
    void expectRefused(const std::vector<std::string>& arguments, const std::string& holds, int exit_code = 2) const {
        const Outcome run = accuracy(arguments);
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
        EXPECT_FALSE(std::filesystem::exists(folder() / "page"));
    }
    void expectRefusedResults(const std::string& bytes, const std::string& holds) const {
        std::ofstream(path("results.json"), std::ios::binary) << bytes;
        expectRefused({"--from", path("results.json"), "-o", path("page")}, holds);
    }
};

TEST_F(AccuracyCli, RefusesOptionsThatItHasNot) {
    expectRefused({"--quik"}, "--quik");
    expectRefused({"-o", ""}, "empty name");
    expectRefused({"--from", kStored, "--quick"}, "--quick");
    expectRefused({"builtin:cube", "--from", kStored}, "--from");
    expectRefused({"--device", "no such device", "-o", path("page")}, "no such device", 4);
}

TEST_F(AccuracyCli, RefusesFoldersThatItCannotWriteTo) {
    expectRefused({"--from", kStored, "-o", "/proc/no"}, "/proc/no");
    std::ofstream(path("file")) << "a file";
    expectRefused({"--from", kStored, "-o", path("file")}, path("file"));
    expectRefused({"--quick", "-o", path("file") + "/below"}, path("file"));
}

// `timeout` sends the signal while the sweep runs.
TEST_F(AccuracyCli, LeavesNothingBehindWhereItIsInterrupted) {
    const std::string command = "timeout --preserve-status -s INT 1.5 " + std::string(BRITTLE_BINARY_DIR) +
                                "/brittle accuracy --quick -o " + path("deep/page") + " 2>/dev/null";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

TEST_F(AccuracyCli, RefusesModelsBeforeItMeasuresAnything) {
    expectRefused({"--quick", path("none.obj"), "-o", path("page")}, "none.obj");
    std::ofstream(path("open.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    expectRefused({"--quick", path("open.obj"), "-o", path("page")}, "open.obj");
}

TEST_F(AccuracyCli, SaysWhatIsWrongWithResultsAndWhere) {
    expectRefused({"--from", path("none.json"), "-o", path("page")}, "none.json: cannot be read");
    expectRefused({"--from", folder().string(), "-o", path("page")}, "cannot be read");
    expectRefusedResults("", "is no JSON");
    expectRefusedResults(fileBytes(kStored).substr(0, 5000), "is no JSON: parse error at line ");
    expectRefusedResults("[1, 2]", "no file of brittle accuracy");
    expectRefusedResults("{\"format\": \"something else\"}", "no file of brittle accuracy");
    json results = json::parse(fileBytes(kStored));
    const auto broken = [&](auto&& change) {
        json changed = results;
        change(changed);
        return changed.dump();
    };
    expectRefusedResults(broken([](json& r) { r["version"] = 99; }), "version 99");
    expectRefusedResults(broken([](json& r) { r["format"] = 7; }), "is not whole");
    expectRefusedResults(broken([](json& r) { r.erase("measurements"); }), "measurements");
    expectRefusedResults(broken([](json& r) { r["measurements"][2].erase("bytes"); }), "/measurements/2");
    expectRefusedResults(broken([](json& r) { r["measurements"][1]["ms"]["median"] = "fast"; }), "/measurements/1/ms/median");
    expectRefusedResults(broken([](json& r) { r["machine"]["cores"] = nullptr; }), "/machine/cores");
    expectRefusedResults(broken([](json& r) { r["measurements"][0]["workload"] = "nothing"; }), "\"nothing\"");
    expectRefusedResults(broken([](json& r) { r["measurements"][0]["errors"][0]["kind"] = "guess"; }), "\"guess\"");
}

TEST_F(AccuracyCli, RefusesResultsThatNoSweepLeaves) {
    const json results = json::parse(fileBytes(kStored));
    const auto expectFlaw = [&](const char* place, const json& value, const std::string& holds) {
        json changed = results;
        changed[json::json_pointer(place)] = value;
        expectRefusedResults(changed.dump(), holds);
    };
    expectFlaw("/measurements/0/is_default", false, "/workloads/0 has no default");
    expectFlaw("/measurements/1/is_default", true, "/workloads/0 has no default that had a result, more than one");
    expectFlaw("/measurements/0/failed", "no result", "/workloads/0 has no default");
    expectFlaw("/measurements/0/ms/raw", json::array(), "/measurements/0/ms/raw is empty");
    expectFlaw("/measurements/0/ms/raw/0", 0, "/measurements/0/ms/raw has a time that is not above 0 ms");
    expectFlaw("/measurements/0/errors", json::array(), "/measurements/0 has no error");
    expectFlaw("/measurements/0/errors/0/value", -1, "/measurements/0/errors/0 is below 0");
    expectFlaw("/measurements/0/errors/0/resolution", 0, "/measurements/0/errors/0 has a resolution");
    expectFlaw("/measurements", json::array(), "/workloads/0 was not measured");
    expectFlaw("/workloads/0/kinds", json::array(), "/workloads/0 has no kind");
    expectFlaw("/workloads/1/name", results["workloads"][0]["name"], "/workloads/1 has the name of another");
    expectFlaw("/figures/0/series", json::array(), "/figures/0 has no point");
    expectFlaw("/figures/0/series/0/points/0/sites", 0, "/figures/0/series/0/points/0 has no sites");
    expectFlaw("/curves/0/series", json::array(), "/curves/0 has no point");
    expectFlaw("/curves/1/series/0/points/0/y", 0, "/curves/1/series/0/points/0 has a coordinate that its axis cannot show");
    expectFlaw("/shares/0/stages", json::array(), "/shares/0 has no sites or took no time");
    expectFlaw("/laws/0/bins", json::array(), "/laws/0/bins is empty");
    expectFlaw("/laws/0/bins/3/to", -1, "/laws/0/bins/3 does not end");
    expectFlaw("/pictures/0/cheap", "", "/pictures/0 has a picture that is no PNG");
    expectFlaw("/hard/0/name", "", "/hard/0 has no name");
}

// Medians, ratios, and which lines are told, are those of the times, whatever stands beside them.
TEST_F(AccuracyCli, FindsWhatFollowsFromTimesAnew) {
    json results = json::parse(fileBytes(kStored));
    const Outcome usual = accuracy({"--from", kStored, "-o", path("usual")});
    for (json& m : results["measurements"]) {
        m["ms"]["median"] = 12345;
        m["times_default"] = -1;
        m["is_dominated"] = true;
    }
    results["useful"] = {{{"text", "made up"}, {"measurement", 100000}}};
    std::ofstream(path("results.json")) << results.dump();
    const Outcome anew = accuracy({"--from", path("results.json"), "-o", path("anew")});
    EXPECT_EQ(anew.exit_code, 0) << anew.err;
    EXPECT_EQ(anew.out.substr(0, anew.out.find("report ")), usual.out.substr(0, usual.out.find("report ")));
    EXPECT_EQ(fileBytes(path("anew/report.html")), fileBytes(path("usual/report.html")));
}

TEST_F(AccuracyCli, WritesThePageOfResultsThatAreThere) {
    const Outcome run = accuracy({"--from", kStored, "-o", path("deep/page")});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder() / "deep/page"), {}), 1);
    const std::string page = fileBytes(path("deep/page/report.html"));
    EXPECT_NE(page.find("</html>"), std::string::npos);
    EXPECT_EQ(page.find("http://"), page.find("http://www.w3.org/"));
    const json results = json::parse(fileBytes(kStored));
    for (const json& line : results["useful"]) {
        const json& measurement = results["measurements"][line["measurement"].get<size_t>()];
        EXPECT_NE(run.out.find(measurement["knob"].get<std::string>() + " " + measurement["setting"].get<std::string>()),
                  std::string::npos)
            << run.out;
    }
}

// A name in the results is words, whatever is in it.
TEST_F(AccuracyCli, LetsNoTextOfTheResultsIntoThePageAsMarkup) {
    json results = json::parse(fileBytes(kStored));
    results["machine"]["device"] = "</script><b id=escaped>";
    std::ofstream(path("results.json")) << results.dump();
    EXPECT_EQ(accuracy({"--from", path("results.json"), "-o", path("page")}).exit_code, 0);
    EXPECT_EQ(fileBytes(path("page/report.html")).find("</script><b"), std::string::npos);
}

class LongAccuracyCli : public AccuracyCli {};

TEST_F(LongAccuracyCli, MeasuresEveryKnobAgainstReferences) {
    const Outcome run = accuracy({"--quick", "-o", path("all")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const json results = json::parse(fileBytes(path("all/results.json")));
    std::set<std::string> knobs, families;
    for (const json& m : results["measurements"]) {
        knobs.insert(m["knob"].get<std::string>());
        if (m["failed"] != "") continue;
        SCOPED_TRACE(m["workload"].get<std::string>() + " " + m["knob"].get<std::string>() + " " +
                     m["setting"].get<std::string>());
        EXPECT_GE(m["ms"]["raw"].size(), 3u);
        EXPECT_GT(m["ms"]["median"].get<double>(), 0);
        EXPECT_LE(m["ms"]["low"].get<double>(), m["ms"]["median"].get<double>());
        EXPECT_GE(m["ms"]["high"].get<double>(), m["ms"]["median"].get<double>());
        EXPECT_GT(m["bytes"].get<double>(), 0);
        EXPECT_FALSE(m["errors"].empty());
        for (const json& error : m["errors"]) {
            EXPECT_GE(error["value"].get<double>(), 0);
            EXPECT_GT(error["resolution"].get<double>(), 0);
        }
    }
    for (const json& workload : results["workloads"])
        families.insert(workload["family"].get<std::string>());
    EXPECT_EQ(families, (std::set<std::string>{"fracture", "colliders", "patterns", "dynamics"}));
    for (const char* knob : {"precision", "caps", "search", "cells", "pattern", "candidates", "relax", "directions", "axes",
                             "ccd", "substeps", "iterations", "dt", "recycling", "precision and caps", "dt and substeps"})
        EXPECT_TRUE(knobs.contains(knob)) << knob;
    EXPECT_EQ(results["figures"].size(), 2u);
    EXPECT_EQ(results["curves"].size(), 4u);
    EXPECT_EQ(results["laws"].size(), 3u);
    EXPECT_EQ(results["pictures"].size(), 2u);
    EXPECT_GT(std::ranges::count(fileBytes(path("all/results.csv")), '\n'), std::ptrdiff_t(results["measurements"].size()));
    // What an exact break costs is nothing of the model.
    for (const json& m : results["measurements"])
        if (m["is_default"] == true && m["errors"][0]["kind"] == "promises") {
            EXPECT_EQ(m["errors"][0]["value"], 0) << m["workload"];
        }
}

} // namespace
