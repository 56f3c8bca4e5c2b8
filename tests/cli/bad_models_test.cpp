// Every model of the collection that is broken, open, passes through itself or is odd in another way, through the program: it
// is refused in one line that says what and where, or it is broken into fragments that keep their contract; with --repair and
// without.
#include "tests/reference/contract.h"
#include "tests/reference/model_file.h"
#include "tests/support/process.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <sstream>

namespace {

using support::Outcome;
using support::runProgram;

struct BadModel {
    const char* name;
    const char* refusal;          // what it says; "" where it can be broken as it is
    const char* refusal_repaired; // the same with --repair
    const char* mended;           // what was mended, "" where nothing was
    const char* sites = "5";
};

void PrintTo(const BadModel& model, std::ostream* out) { *out << model.name; }

constexpr const char* kSound = "";

// The reader's word: nothing can be mended in what cannot be read.
constexpr BadModel unreadable(const char* name, const char* refusal) { return {name, refusal, refusal, ""}; }
constexpr BadModel sound(const char* name) { return {name, kSound, kSound, ""}; }

constexpr BadModel kModels[] = {
    unreadable("bad/fandisk-truncated.off", "face 4593 of 12946"),
    unreadable("bad/gearwheel-truncated.stl", "promises 2444 triangles in 122284 bytes but it has 85598"),
    sound("bad/gearwheel-count-huge.stl"),
    sound("bad/gearwheel-solid-header.stl"),
    unreadable("bad/spot-nan.obj", "line 10: a coordinate is not a finite number"),
    unreadable("bad/torus-index-out-of-range.obj", "line 2358: a face refers to a vertex that is not there"),
    unreadable("bad/bones-face-count-too-big.off", "face 4204 of 4704"),
    unreadable("bad/WaterBottle-truncated.glb", "promises 109484 bytes"),
    unreadable("bad/abdomen-truncated.dae", "float_array has 28129 numbers, its count is 48456"),
    unreadable("bad/spider-truncated.fbx", "cannot be read"),
    unreadable("bad/empty.obj", "the file is empty"),
    unreadable("bad/vertices-only.obj", "829 vertices but no faces"),
    unreadable("bad/header-only.ply", "vertex 0 of 99519"),
    unreadable("bad/huge-count.ply", "vertex 4 of 4000000000"),
    unreadable("bad/random-bytes.stl", "the file is damaged or not STL"),
    unreadable("bad/stl-named.obj", "binary data where OBJ text was expected"),
    sound("bad/spot-bigendian-double.ply"),
    {"bad/torus-double-sided.obj", "4608 doubled triangles, first at (1.24343,", kSound, "4608 doubled triangles dropped"},
    {"bad/spot-30pct-flipped.obj", "1063 edges, first at (", kSound, "483 triangles turned over"},
    {"bad/spot-t-junctions.obj", "180 open edges, first at (", kSound, "60 edges split where others end on it"},
    sound("bad/torus-collinear-triangles.obj"),
    {"bad/gearwheel-jitter-1e-6.stl", "7332 open edges, first at (", kSound, "6110 vertices joined to the one beside it"},
    sound("bad/torus-scale-1e-6.obj"),
    sound("bad/trefoil-scale-1e7.obj"),
    sound("bad/couplingdown-offset-1e6.off"),
    sound("bad/gearwheel-offset-1e5-float32.stl"),
    sound("bad/hollow-ico4-wall-2pct.obj"),
    {"bad/one-triangle.stl", "3 open edges, first at (", "around (0.333333, 0.333333, 0), cannot be closed", ""},
    sound("bad/torus-stray-vertices.obj"),
    {"bad/ico4-flattened.obj", "331 doubled triangles, first at (", "331 doubled triangles, first at (", ""},
    sound("bad/l-prism-concave-ngons.obj"),
    // Open.
    {"WaterBottle.glb", "264 open edges, first at (", "8 holes left open; the first, of 40 edges", ""},
    {"elephant-with-holes.off", "1353 open edges, first at (", "3 holes left open; the first, of 29 edges", ""},
    {"terrain.ply", "412 open edges, first at (", "1 hole left open; the first, of 412 edges", ""},
    {"seaVase.ply", "1152 open edges, first at (", "27 holes left open; the first, of 2 edges", ""},
    {"moebius.obj", "112 open edges, first at (", "one side only, like a Moebius strip, first seen at (3.01546,", ""},
    // Passing through themselves; the teapot does so by rounding only.
    {"bones.off", "366 pairs of triangles that cross, 0.126594 deep at (", "366 pairs of triangles that cross", ""},
    {"self_intersectA.obj", "278 pairs of triangles that cross, 0.00691563 deep at (", "278 pairs of triangles that cross", ""},
    {"spider.fbx", "72 open edges, first at (", "pairs of triangles that cross", ""},
    sound("utah_teapot.stl"),
    // Not manifold, or not of one mind.
    {"openscad-nonmanifold-crash.obj", "3 doubled triangles, first at (", "3 edges, first at (-17.1775,", ""},
    {"blobby-shuffled.off", "3069 edges, first at (", kSound, "2017 triangles turned over"},
};

// 400,020 triangles.
constexpr BadModel kLargeModel = {"buildings.ply", "3 edges, first at (", kSound,
                                  "1 triangle turned over at (96.9366, 68.152, 9.00363)",
                                  "3"}; // with cut faces of thousands of sides

class BadModels : public testing::TestWithParam<BadModel> {
protected:
    void SetUp() override {
        SKIP_WITHOUT_MESHES();
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string model() const { return support::sharedMesh(GetParam().name).string(); }

    static std::string withoutNotes(const std::string& err) {
        std::istringstream lines(err);
        std::string rest;
        for (std::string line; std::getline(lines, line);)
            if (line.find(": note: ") == line.npos) rest += line + '\n';
        return rest;
    }

    Outcome shatter(std::vector<std::string> more) const {
        std::vector<std::string> arguments = {"shatter", model(), "-o", path("a.glb"), "--sites", GetParam().sites, "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram("brittle", arguments);
    }

    // Beside notes of the reader, one line that names the model and says so; exit code 2; nothing written.
    void expectRefused(const Outcome& run, const std::string& words) const {
        EXPECT_EQ(run.exit_code, 2) << run.err;
        const std::string refusal = withoutNotes(run.err);
        EXPECT_EQ(std::count(refusal.begin(), refusal.end(), '\n'), 1) << run.err;
        EXPECT_EQ(run.err.rfind("brittle: " + model() + ": ", 0), 0u) << run.err;
        EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder_));
    }

    // The model as it was broken is written by the doctor and read by the checker's own reader.
    void expectContract(const Outcome& run) const {
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const Outcome doctor = runProgram("brittle", {"doctor", model(), "--repair", "-o", path("model.obj")});
        ASSERT_EQ(doctor.exit_code, 0) << doctor.err;
        const reference::ContractReport report =
            reference::checkContract(reference::readFragmentFile(path("a.glb")), reference::readModel(path("model.obj")));
        EXPECT_TRUE(report.holds()) << report.text();
    }

private:
    const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "brittle_bad_models";
};

TEST_P(BadModels, AsTheyAre) {
    const Outcome run = shatter({});
    if (*GetParam().refusal != '\0') return expectRefused(run, GetParam().refusal);
    EXPECT_EQ(withoutNotes(run.err), "");
    expectContract(run);
}

TEST_P(BadModels, Repaired) {
    const Outcome run = shatter({"--repair"});
    if (*GetParam().refusal_repaired != '\0') return expectRefused(run, GetParam().refusal_repaired);
    if (*GetParam().mended == '\0') {
        EXPECT_EQ(withoutNotes(run.err), "");
        if (*GetParam().refusal == '\0') return; // nothing was mended: AsTheyAre has checked the rest
    }
    const std::string mended = withoutNotes(run.err);
    EXPECT_EQ(std::count(mended.begin(), mended.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find(std::string(": mended: ") + GetParam().mended), std::string::npos) << run.err;
    expectContract(run);
    EXPECT_TRUE(nlohmann::json::parse(run.out).contains("mended"));
}

std::string nameOf(const testing::TestParamInfo<BadModel>& parameter) {
    std::string name = parameter.param.name;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Shared, BadModels, testing::ValuesIn(kModels), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, BadModels, testing::Values(kLargeModel), nameOf);

TEST(BadModelsTable, HoldsEveryFileOfTheFolder) {
    SKIP_WITHOUT_MESHES();
    for (const auto& entry : std::filesystem::directory_iterator(support::sharedMesh("bad"))) {
        const std::string name = "bad/" + entry.path().filename().string();
        if (name == "bad/README.md") continue;
        EXPECT_TRUE(std::any_of(std::begin(kModels), std::end(kModels), [&](const BadModel& m) { return name == m.name; }))
            << name;
    }
}

} // namespace
