// Runs scenes on the system's device and on a newer lavapipe, and compares them in outline: motion is the same to the bit on
// one driver with one compiler only. LongMotion writes the table of modules/brittle/docs/drivers.md.
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

namespace {

using nlohmann::json;
using support::Outcome;

constexpr int kSkipCode = 77;

struct Scene {
    std::string name; // a built-in scene, or an example if it ends with .toml
    double seconds;
};

const std::vector<Scene> kShort = {{"stack_10", 2}, {"hard_17_bounce_50", 1}, {"hard_13_head_on", 1}, {"window_pane.toml", 1}};

const std::vector<Scene> kLong = {{"stack_10", 2},
                                  {"stack_40", 2},
                                  {"bounce", 3},
                                  {"slope", 3},
                                  {"card_house", 3},
                                  {"hull_pile_100", 3},
                                  {"hard_01_block_100", 3},
                                  {"hard_02_standing_block", 3},
                                  {"hard_03_overlap_10cm", 2},
                                  {"hard_04_inflated_1mm", 2},
                                  {"hard_06_heavy_on_light_100", 3},
                                  {"hard_08_intermediate_axis", 3},
                                  {"hard_09_thin_rod", 3},
                                  {"hard_10_wall_300", 2},
                                  {"hard_11_plate_300", 2},
                                  {"hard_13_head_on", 2},
                                  {"hard_14_flat_plate_2mm", 2},
                                  {"hard_15_slivers_20mm", 2},
                                  {"hard_16_slope_45", 3},
                                  {"hard_17_bounce_50", 3},
                                  {"hard_18_implosion", 2},
                                  {"hard_19_far_100km", 2},
                                  {"window_pane.toml", 2},
                                  {"quiet_shelf.toml", 2},
                                  {"ice_block.toml", 2},
                                  {"wrecking_ball.toml", 2},
                                  {"dropped_vase.toml", 2},
                                  {"crumbling_wall.toml", 2},
                                  {"ten_at_once.toml", 2}};

std::string sourceOf(const Scene& scene) {
    if (!scene.name.ends_with(".toml")) return scene.name;
    return std::string(BRITTLE_SOURCE_DIR) + "/modules/brittle/scene/examples/" + scene.name;
}

std::vector<std::string> argumentsFor(const Scene& scene) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", scene.seconds);
    return {"simulate", sourceOf(scene), "--seconds", seconds, "--json"};
}

json reportOf(const Outcome& run, const Scene& scene) {
    EXPECT_EQ(run.exit_code, 0) << scene.name << ": " << run.err;
    return json::parse(run.out, nullptr, false);
}

json onSystemDevice(const Scene& scene) { return reportOf(support::runProgram("brittle", argumentsFor(scene)), scene); }

// Runs brittle by the script, which ends with kSkipCode if no newer lavapipe can be had.
Outcome onNewerLavapipe(std::vector<std::string> arguments) {
    const std::string script =
        std::filesystem::relative(BRITTLE_SOURCE_DIR "/tools/newer_lavapipe.sh", BRITTLE_BINARY_DIR).string();
    arguments.insert(arguments.begin(), std::string(BRITTLE_BINARY_DIR) + "/brittle");
    return support::runProgram(script, arguments);
}

bool hasNewerLavapipe() { return onNewerLavapipe({"devices"}).exit_code != kSkipCode; }

// Checks the promises for every device: the run ends well, with finite numbers, and accounts for every fragment.
void expectSound(const json& report, const Scene& scene) {
    ASSERT_TRUE(report.is_object()) << scene.name;
    ASSERT_TRUE(report["kinetic_energy"].is_number()) << scene.name; // JSON has no NaN
    EXPECT_TRUE(std::isfinite(report["kinetic_energy"].get<double>())) << scene.name;
    EXPECT_GE(report["kinetic_energy"].get<double>(), 0) << scene.name;
    EXPECT_EQ(report["breaks_lost"], 0) << scene.name;
    EXPECT_EQ(report["bodies_at_end"].get<int64_t>(), report["bodies"].get<int64_t>() - report["broken"].get<int64_t>() +
                                                          report["fragments"].get<int64_t>() - report["expired"].get<int64_t>())
        << scene.name;
}

std::string rowOf(const Scene& scene, const json& here, const json& newer) {
    const auto both = [&](const char* key) { return here[key].dump() + " / " + newer[key].dump(); };
    char energy[64];
    std::snprintf(energy, sizeof energy, "%.4g / %.4g", here["kinetic_energy"].get<double>(),
                  newer["kinetic_energy"].get<double>());
    return "| `" + scene.name + "` | " + (here["state_hash"] == newer["state_hash"] ? "same" : "differs") + " | " +
           both("broken") + " | " + both("fragments") + " | " + energy + " | " + both("awake") + " | " + both("bodies_at_end") +
           " |\n";
}

class Motion : public testing::Test {
protected:
    void SetUp() override {
        if (!hasNewerLavapipe()) GTEST_SKIP() << "no newer lavapipe can be had here (tools/newer_lavapipe.sh)";
    }
};

class LongMotion : public Motion {};

TEST_F(Motion, IsSoundOnBothAndBreaksTheSameBodies) {
    for (const Scene& scene : kShort) {
        const json here = onSystemDevice(scene), newer = reportOf(onNewerLavapipe(argumentsFor(scene)), scene);
        expectSound(here, scene);
        expectSound(newer, scene);
        if (HasFatalFailure()) return;
        EXPECT_NE(here["device"], newer["device"]);
        EXPECT_EQ(here["broken"], newer["broken"]) << scene.name;
    }
}

TEST_F(LongMotion, IsWrittenIntoATable) {
    const std::filesystem::path folder = std::string(BRITTLE_BINARY_DIR) + "/../device-test";
    std::filesystem::create_directories(folder);
    std::ofstream table(folder / "motion.md");
    table << "| scene | state | broken | fragments | kinetic energy, J | awake | bodies |\n|---|---|---|---|---|---|---|\n";
    for (const Scene& scene : kLong) {
        const json here = onSystemDevice(scene), newer = reportOf(onNewerLavapipe(argumentsFor(scene)), scene);
        expectSound(here, scene);
        expectSound(newer, scene);
        if (HasFatalFailure()) return;
        table << rowOf(scene, here, newer) << std::flush;
    }
}

} // namespace
