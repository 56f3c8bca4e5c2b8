// --budget-ms and --tolerance as their users meet them: prices are those of a file in the cache.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

using nlohmann::json;
using support::fileBytes;
using support::Outcome;
using support::runProgram;

class AutoCli : public support::FolderTest {
protected:
    // Kernels stay where the driver keeps them otherwise, or each run would compile all of them.
    Outcome run(const std::vector<std::string>& arguments) const {
        const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
        const std::string usual = cache != nullptr ? cache : std::string(home != nullptr ? home : "/tmp") + "/.cache";
        return runProgram("brittle", arguments, {"XDG_CACHE_HOME=" + folder().string(), "MESA_SHADER_CACHE_DIR=" + usual});
    }
    // Measured on lavapipe, which is what these tests run on.
    void storePrices() const {
        storePrices([](json&) {});
    }
    template <class Change>
    void storePrices(const Change& change) const {
        json stored = measuredPrices();
        const std::string name = slug(stored);
        change(stored);
        std::filesystem::create_directories(folder() / "brittle");
        std::ofstream(folder() / "brittle" / name) << stored.dump();
    }
    static json measuredPrices() {
        return json::parse(fileBytes(std::string(BRITTLE_SOURCE_DIR) + "/tests/cli/accuracy_results.json"));
    }
    static std::string slug(const json& stored) {
        std::string name = "prices_";
        for (const char c :
             stored["machine"]["device"].get<std::string>() + " " + stored["machine"]["driver"].get<std::string>())
            if (std::isalnum(static_cast<unsigned char>(c)) != 0)
                name += c;
            else if (name.back() != '_')
                name += '_';
        return name + ".json";
    }
};

TEST_F(AutoCli, WithoutPricesOfTheDeviceItSaysHowToMeasureThem) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"shatter", "builtin:cube", "-o", path("a.glb"), "--budget-ms", "5"},
          std::vector<std::string>{"simulate", "stack_3", "--json", "--tolerance", "100"}}) {
        const Outcome out = run(arguments);
        EXPECT_EQ(out.exit_code, 2);
        EXPECT_NE(out.err.find("brittle accuracy --quick"), std::string::npos) << out.err;
        EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
    }
}

TEST_F(AutoCli, PricesThatAreDamagedAreRefusedWithWhatToDo) {
    const auto expectRefused = [&](const std::string& holds) {
        const Outcome out = run({"shatter", "builtin:cube", "-o", path("a.glb"), "--budget-ms", "5"});
        EXPECT_EQ(out.exit_code, 2) << out.out;
        EXPECT_NE(out.err.find(holds), std::string::npos) << out.err;
        EXPECT_NE(out.err.find("measure anew"), std::string::npos) << out.err;
        EXPECT_EQ(std::ranges::count(out.err, '\n'), 1) << out.err;
        EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
    };
    storePrices([](json& prices) { prices["measurements"] = json::array(); });
    expectRefused("/workloads/0 was not measured");
    storePrices([](json& prices) { prices["measurements"] = prices["workloads"] = prices["peers"] = json::array(); });
    expectRefused("holds no price of fracture");
    const std::string whole = measuredPrices().dump(), name = slug(measuredPrices());
    std::ofstream(folder() / "brittle" / name) << whole.substr(0, whole.size() / 2);
    expectRefused("is no JSON");
}

TEST_F(AutoCli, AStepHasToBeTakenForOneToBePicked) {
    storePrices();
    const Outcome out = run({"simulate", "stack_3", "--json", "--seconds", "0", "--budget-ms", "1"});
    EXPECT_EQ(out.exit_code, 2);
    EXPECT_NE(out.err.find("give more --seconds"), std::string::npos) << out.err;
}

// As where another version has measured them.
TEST_F(AutoCli, SettingsThatThisVersionHasNotGotAreNotPicked) {
    storePrices([](json& prices) {
        for (json& m : prices["measurements"])
            if (m["knob"] == "search") m["setting"] = "crystal ball", m["ms"]["raw"] = {1e-6};
    });
    const Outcome out = run({"shatter", "builtin:cube", "-o", path("a.glb"), "--tolerance", "1", "--json"});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    EXPECT_NE(json::parse(out.out)["picked"]["setting"], "crystal ball");
}

TEST_F(AutoCli, ShatterPicksSaysWhichAndWhy) {
    storePrices();
    const Outcome out = run({"shatter", "builtin:cube", "-o", path("a.glb"), "--tolerance", "1e-6", "--json"});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    const json picked = json::parse(out.out)["picked"];
    EXPECT_NE(picked["knob"], "caps") << "which errs by more than that";
    EXPECT_LE(picked["error"], 1e-6);
    EXPECT_GT(picked["taken_ms"], 0);
    EXPECT_NE(picked["why"].get<std::string>().find("fastest within a tolerance of 1e-06"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(path("a.glb")));
}

// Fans are the fastest of all prices here, and wrong where a model is not convex: then its fragments are the usual ones.
TEST_F(AutoCli, ShatterKeepsTheUsualFragmentsWhereWhatItPickedBreaksThem) {
    storePrices();
    const Outcome usual = run({"shatter", "builtin:ring", "-o", path("usual.glb"), "--sites", "30"});
    ASSERT_EQ(usual.exit_code, 0) << usual.err;
    const Outcome out =
        run({"shatter", "builtin:ring", "-o", path("a.glb"), "--sites", "30", "--budget-ms", "0.001", "--json"});
    ASSERT_EQ(out.exit_code, 0) << out.err;
    const json picked = json::parse(out.out)["picked"];
    EXPECT_EQ(picked["keeps_budget"], false);
    if (picked["knob"] == "caps") {
        EXPECT_TRUE(picked.contains("fell_back"));
    }
    EXPECT_EQ(fileBytes(path("a.glb")), fileBytes(path("usual.glb"))) << "search and mapping make the same bytes";
}

TEST_F(AutoCli, SimulateTakesStepsOfTheLengthItPicked) {
    storePrices();
    const auto stepsOf = [&](const std::vector<std::string>& wish) {
        std::vector<std::string> arguments = {"simulate", "hull_pile_20", "--json", "--seconds", "0.5"};
        arguments.insert(arguments.end(), wish.begin(), wish.end());
        const Outcome out = run(arguments);
        EXPECT_EQ(out.exit_code, 0) << out.err;
        return json::parse(out.out);
    };
    EXPECT_FALSE(stepsOf({}).contains("picked"));
    const json fine = stepsOf({"--tolerance", "5"}), coarse = stepsOf({"--tolerance", "100"});
    EXPECT_EQ(fine["picked"]["setting"], "1/240 s");
    EXPECT_EQ(fine["steps"], 120);
    EXPECT_LE(coarse["picked"]["error"], 100);
    EXPECT_LT(coarse["picked"]["expected_ms"], fine["picked"]["expected_ms"]);
}

TEST_F(AutoCli, RefusesWhatCannotBeHad) {
    storePrices();
    const Outcome out = run({"simulate", "hull_pile_20", "--json", "--seconds", "0.1", "--tolerance", "1e-9"});
    EXPECT_EQ(out.exit_code, 2);
    EXPECT_NE(out.err.find("no setting is within a tolerance of 1e-09; the least"), std::string::npos) << out.err;
    EXPECT_EQ(run({"shatter", "builtin:cube", "-o", path("a.glb"), "--budget-ms", "nan"}).exit_code, 2);
    EXPECT_EQ(run({"shatter", "builtin:cube", "-o", path("a.glb"), "--tolerance", "-1"}).exit_code, 2);
}

// It would say that it took one thing, and take the other.
TEST_F(AutoCli, ShatterRefusesToPickWhatIsGiven) {
    storePrices();
    for (const auto& [knob, value] :
         {std::pair{"--precision", "fast"}, {"--caps", "convex"}, {"--search", "linear"}, {"--cells", "edges"}}) {
        const Outcome out = run({"shatter", "builtin:cube", "-o", path("a.glb"), knob, value, "--tolerance", "1"});
        EXPECT_EQ(out.exit_code, 2);
        EXPECT_NE(out.err.find(std::string(knob) + " excludes --tolerance"), std::string::npos) << out.err;
        EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
    }
}

} // namespace
