// The program as its users meet it: exit codes, one-line errors, no output where something is wrong, the same bytes twice.
#include "tests/reference/glb_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/process.h"
#include "tests/support/shared_meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <regex>

namespace {

using support::fileBytes;
using support::Outcome;
using support::runProgram;

class Cli : public support::FolderTest {
protected:
    // One line on stderr, the expected exit code, and nothing left behind.
    void expectRefused(std::vector<std::string> arguments, int exit_code) {
        const std::filesystem::path output = folder() / "refused.glb";
        arguments.insert(arguments.end(), {"-o", output.string()});
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(output));
        EXPECT_TRUE(run.out.empty()) << run.out;
        for (const auto& entry : std::filesystem::directory_iterator(folder()))
            EXPECT_EQ(entry.path().filename().string().find("refused"), std::string::npos) << entry.path();
    }
};

class LongCli : public Cli {};

TEST_F(Cli, ShatterWritesFragmentsAndReportsThem) {
    const Outcome run =
        runProgram("brittle", {"shatter", "builtin:icosphere:3", "-o", path("a.glb"), "--sites", "12", "--verify", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    for (const char* key : {"device", "model", "sites", "cells", "fragments", "volume_error", "area_error", "open_edges",
                            "unpaired_inner_triangles", "exact_cells", "ms"})
        EXPECT_TRUE(report.contains(key)) << key;
    for (const char* key : {"vertices", "triangles", "components", "volume", "area"})
        EXPECT_TRUE(report["model"].contains(key)) << key;
    EXPECT_EQ(report["sites"]["used"], 12);
    EXPECT_EQ(report["cells"]["ok"], 12);
    EXPECT_EQ(report["cells"]["refused"], 0);
    EXPECT_EQ(report["open_edges"], 0);
    EXPECT_GT(report["ms"]["total"].get<double>(), 0);
    const reference::FragmentFile file = reference::readFragmentFile(path("a.glb"));
    EXPECT_EQ(file.pieces.size(), report["fragments"].get<size_t>());
    EXPECT_TRUE(file.faults.empty());
}

TEST_F(Cli, TheSameSeedGivesTheSameBytes) {
    const auto shatter = [&](const std::string& name, const std::string& seed, const std::string& threads) {
        const Outcome run =
            runProgram("brittle", {"shatter", "builtin:ring", "-o", path(name), "--sites", "50", "--seed", seed},
                       {"LP_NUM_THREADS=" + threads});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return fileBytes(path(name));
    };
    const std::string first = shatter("first.glb", "7", "2");
    ASSERT_FALSE(first.empty());
    EXPECT_EQ(shatter("again.glb", "7", "2"), first);
    EXPECT_EQ(shatter("one.glb", "7", "1"), first);
    EXPECT_EQ(shatter("none.glb", "7", "0"), first);
    EXPECT_NE(shatter("other.glb", "8", "2"), first);
}

TEST_F(Cli, TheSameBytesFromWorkgroupsOfAnySize) {
    const auto shatter = [&](const std::string& size) {
        const Outcome run = runProgram("brittle", {"shatter", "builtin:ring", "-o", path(size), "--group-size", size});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return fileBytes(path(size));
    };
    const std::string usual = shatter("64");
    ASSERT_FALSE(usual.empty());
    EXPECT_TRUE(shatter("16") == usual);
}

// Other widths of subgroups have tests of their own (tests/device).
TEST_F(LongCli, TheSameBytesWhateverTheThreads) {
    const auto shatter = [&](std::vector<std::string> arguments, const std::vector<std::string>& environment) {
        arguments.insert(arguments.begin(), "shatter");
        arguments.insert(arguments.end(), {"-o", path("a.glb")});
        const Outcome run = runProgram("brittle", arguments, environment);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return fileBytes(path("a.glb"));
    };
    const std::vector<std::vector<std::string>> events = {
        {"builtin:ring", "--sites", "300"},
        {"builtin:bumpy:4", "--sites", "1000", "--group-size", "8"},
        {"builtin:bumpy:3", "--sites", "150", "--at", "0,0,.5", "--strength", "3"},
        {"builtin:bumpy:3", "--sites", "200", "--search", "linear"},
    };
    std::vector<std::string> usual;
    for (const auto& event : events) {
        usual.push_back(shatter(event, {}));
        ASSERT_FALSE(usual.back().empty());
    }
    for (const char* setting : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=2"})
        for (size_t k = 0; k < events.size(); ++k)
            EXPECT_TRUE(shatter(events[k], {setting}) == usual[k]) << setting << ", " << events[k][0];
}

TEST_F(Cli, CapsOfAConvexModelInAnother) {
    const Outcome right = runProgram("brittle", {"shatter", "builtin:cube", "-o", path("a.glb"), "--caps", "convex"});
    EXPECT_EQ(right.exit_code, 0) << right.err;
    const Outcome wrong = runProgram("brittle", {"shatter", "builtin:ring", "-o", path("b.glb"), "--caps", "convex"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("turned over; nothing was written; the model is not convex where it was cut: use --caps exact"),
              std::string::npos)
        << wrong.err;
    EXPECT_FALSE(std::filesystem::exists(path("b.glb")));
}

TEST_F(Cli, SitesFromAFile) {
    std::ofstream(path("sites.txt")) << "# three in the cube\n-.25 0 0\n.25 0 0\n\n0 .25 .1  # the last\n";
    const Outcome run =
        runProgram("brittle", {"shatter", "builtin:cube", "-o", path("a.glb"), "--sites-file", path("sites.txt"), "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["sites"]["used"], 3);
    const reference::FragmentFile file = reference::readFragmentFile(path("a.glb"));
    ASSERT_EQ(file.pieces.size(), 3u);
    for (size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(file.pieces[0].site[k], k == 0 ? -.25 : 0, 1e-6);
}

TEST_F(Cli, APaneInSpokesAndRings) {
    std::ofstream(path("pane.off")) << "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 .01\n1 0 .01\n1 1 .01\n0 1 .01\n"
                                       "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
    const auto shatter = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"shatter",   path("pane.off"), "-o",    path("a.glb"),
                                              "--pattern", "radial",         "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runProgram("brittle", arguments);
    };
    const Outcome run = shatter({"--at", "1,0.4,0.01", "--sites", "61", "--strength", "2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["sites"]["used"], 61);
    EXPECT_EQ(nlohmann::json::parse(run.out)["fragments"], 61);
    EXPECT_EQ(shatter({}).exit_code, 0) << "hit in the middle where nothing is said";
    const Outcome beside = shatter({"--at", "1.5,0,0"});
    EXPECT_EQ(beside.exit_code, 2);
    EXPECT_NE(beside.err.find("lies beside the model"), std::string::npos) << beside.err;
}

TEST_F(Cli, BadUsageIsRefused) {
    EXPECT_EQ(runProgram("brittle", {}).exit_code, 2);
    EXPECT_EQ(runProgram("brittle", {"break"}).exit_code, 2);
    EXPECT_EQ(runProgram("brittle", {"shatter", "builtin:cube"}).exit_code, 2) << "no output named";
    const Outcome drawn = runProgram("brittle", {"shatter", "builtin:cube", "-o", path("cube.png")});
    EXPECT_EQ(drawn.exit_code, 2);
    EXPECT_NE(drawn.err.find("--picture draws them"), std::string::npos) << drawn.err;
    expectRefused({"shatter", "builtin:cube", "--sites", "0"}, 2);
    expectRefused({"shatter", "builtin:cube", "--sites", "many"}, 2);
    for (const char* seed : {"-1", "99999999999999999999", "one"})
        expectRefused({"shatter", "builtin:cube", "--seed", seed}, 2);
    expectRefused({"shatter", "builtin:cube", "--explode", "nan"}, 2);
    for (const char* size : {"0", "4", "48", "512", "-64", "many"})
        expectRefused({"shatter", "builtin:cube", "--group-size", size}, 2);
    expectRefused({"shatter", "builtin:cube", "--precision", "half"}, 2);
    expectRefused({"shatter", "builtin:cube", "--cells", "corners"}, 2);
    for (const char* search : {"linear", "sphere_tree"})
        expectRefused({"shatter", "builtin:cube", "--cells", "edges", "--search", search}, 2);
    expectRefused({"shatter", "builtin:cube", "--strength", "5"}, 2);
    expectRefused({"shatter", "builtin:cube", "--at", "0,0,0", "--pattern", "uniform"}, 2);
    expectRefused({"shatter", "builtin:cube", "--pattern", "radial"}, 2);
    expectRefused({"shatter", "builtin:nothing"}, 2);
    expectRefused({"shatter", path("missing.obj")}, 2);
    expectRefused({"shatter", "builtin:cube", "--sites-file", path("missing.txt")}, 2);
    std::ofstream(path("bad.txt")) << "0 0 0\n1 2\n";
    expectRefused({"shatter", "builtin:cube", "--sites-file", path("bad.txt")}, 2);
    expectRefused({"shatter", "builtin:cube", "--device", "no such device"}, 4);
}

TEST_F(Cli, LessThanExactPrecisionWorksOrSaysWhatDoes) {
    std::ofstream lattice(path("lattice.txt"));
    for (int k = 0; k < 64; ++k)
        lattice << k % 4 << ' ' << k / 4 % 4 << ' ' << k / 16 << '\n';
    lattice.close();
    for (const char* precision : {"double", "fast"}) {
        SCOPED_TRACE(precision);
        const Outcome plain = runProgram("brittle", {"shatter", "builtin:bumpy:3", "-o", path("plain.glb"), "--sites", "40",
                                                     "--precision", precision, "--verify"});
        EXPECT_EQ(plain.exit_code, 0) << plain.err;
        const Outcome tied = runProgram("brittle", {"shatter", "builtin:cube", "-o", path("tied.glb"), "--sites-file",
                                                    path("lattice.txt"), "--precision", precision});
        EXPECT_EQ(std::filesystem::exists(path("tied.glb")), tied.exit_code == 0);
        if (tied.exit_code == 0) continue;
        EXPECT_TRUE(tied.exit_code == 2 || tied.exit_code == 3) << tied.exit_code << tied.err;
        EXPECT_NE(tied.err.find("exact"), std::string::npos) << tied.err;
    }
}

TEST_F(Cli, OddSitesFilesAreRefused) {
    expectRefused({"shatter", "builtin:cube", "--sites-file", path("")}, 2);
    expectRefused({"shatter", "builtin:cube", "--sites-file", "/dev/zero"}, 2);
    std::ofstream(path("mark.txt")) << "\xEF\xBB\xBF"
                                       "0 0 0\n";
    EXPECT_EQ(
        runProgram("brittle", {"shatter", "builtin:cube", "--sites-file", path("mark.txt"), "-o", path("mark.glb")}).exit_code,
        0);
}

TEST_F(Cli, AnUnwritableOutputIsRefused) {
    const Outcome run = runProgram("brittle", {"shatter", "builtin:cube", "-o", path("no/such/folder/a.glb")});
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST_F(Cli, NamesThatPromiseAnotherFormatAreRefused) {
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{path("a.txt")}, {path("a.glb"), "--picture", path("a.jpg")}}) {
        std::vector<std::string> arguments = {"shatter", "builtin:cube", "-o"};
        arguments.insert(arguments.end(), names.begin(), names.end());
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, 2) << run.err;
        EXPECT_NE(run.err.find("let its name end in"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(names.front()));
    }
}

// Some commands print more than a buffer holds, and some print less.
TEST_F(Cli, AFullDiskBehindStandardOutputIsAnError) {
    for (const std::string& words :
         {std::string("plan card_house --json"), std::string("scenes --json"), std::string("scenes --keys"),
          std::string("scenes"), "shatter builtin:cube -o " + path("a.glb"),
          "simulate stack_10 --seconds 0.1 --json -o " + path("b.glb"), "doctor builtin:cube --repair -o " + path("c.obj")}) {
        const Outcome run =
            runProgram("/bin/sh", {"-c", "exec \"$0\" " + words + " > /dev/full", support::programPath("brittle")});
        EXPECT_EQ(run.exit_code, 2) << words;
        EXPECT_NE(run.err.find("standard output cannot be written"), std::string::npos) << words << ": " << run.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

TEST_F(Cli, UnknownWordsAreAnsweredWithTheNearest) {
    const auto expectSays = [](const std::vector<std::string>& words, const std::string& said) {
        const Outcome run = runProgram("brittle", words);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.err, "brittle: " + said + "\n");
    };
    expectSays({"shater", "builtin:cube"}, "there is no subcommand 'shater', did you mean 'shatter'?");
    expectSays({"window"}, "there is no subcommand 'window'; brittle --help lists them");
    expectSays({}, "no subcommand is given; brittle --help lists them");
    expectSays({"--helpp"}, "brittle has no option '--helpp', did you mean '--help'?");
    expectSays({"shatter", "builtin:cube", "-o", path("a.glb"), "--sitez=3"},
               "brittle shatter has no option '--sitez', did you mean '--sites'?");
    expectSays({"simulate", "stack_10", "--zzz"},
               "brittle simulate has no option '--zzz'; brittle simulate --help lists its options");
}

TEST_F(Cli, TellsItsVersion) {
    const Outcome run = runProgram("brittle", {"--version"});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_TRUE(std::regex_match(run.out, std::regex("brittle [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << run.out;
}

TEST_F(Cli, ExamplesAreFoundByName) {
    for (const char* scene : {"window_pane", "crumbling_wall", "window_pane.toml", "dropped_vase"}) {
        const Outcome run = runProgram("brittle", {"scenes", scene});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("name = \""), std::string::npos) << run.out;
    }
    const Outcome near = runProgram("brittle", {"scenes", "window_pain"});
    EXPECT_EQ(near.err, "brittle: no scene is named 'window_pain', did you mean 'window_pane'?\n");
    EXPECT_EQ(runProgram("brittle", {"doctor", "vase.obj"}).exit_code, 0);
    EXPECT_NE(runProgram("brittle", {"scenes"}).out.find("window_pane"), std::string::npos);
}

// By whatever name, through whatever link.
TEST_F(Cli, NoOutputReplacesAnInput) {
    const std::string model = path("model.off"), link = path("link.off"), sites = path("sites.txt");
    std::ofstream(model) << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    std::ofstream(sites) << "0.1 0.1 0.1\n";
    std::filesystem::create_symlink(model, link);
    const std::string before = fileBytes(model), sites_before = fileBytes(sites), good = path("good.glb");
    const std::vector<std::vector<std::string>> runs = {
        {"-o", model},
        {"-o", link},
        {"-o", path("../" + std::filesystem::path(path("")).parent_path().filename().string() + "/model.off")},
        {"-o", good, "--picture", model},
        {"-o", good, "--sites-file", sites, "--picture", sites},
        {"-o", good, "--picture", good}};
    for (std::vector<std::string> arguments : runs) {
        arguments.insert(arguments.begin(), {"shatter", model});
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, 2) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_EQ(fileBytes(model), before);
        EXPECT_EQ(fileBytes(sites), sites_before);
        EXPECT_FALSE(std::filesystem::exists(good));
    }
}

TEST_F(Cli, HelpIsNoError) {
    for (const char* command : {"shatter", "devices", "doctor"}) {
        const Outcome run = runProgram("brittle", {command, "--help"});
        EXPECT_EQ(run.exit_code, 0);
        EXPECT_FALSE(run.out.empty());
    }
}

TEST_F(Cli, DevicesListsWhatThereIs) {
    const Outcome run = runProgram("brittle", {"devices"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_FALSE(run.out.empty());
}

TEST_F(Cli, BrokenFilesAreRefused) {
    SKIP_WITHOUT_MESHES();
    for (const char* name : {"bad/fandisk-truncated.off",
                             "bad/gearwheel-truncated.stl",
                             "bad/spot-nan.obj",
                             "bad/torus-index-out-of-range.obj",
                             "bad/bones-face-count-too-big.off",
                             "bad/WaterBottle-truncated.glb",
                             "bad/abdomen-truncated.dae",
                             "bad/spider-truncated.fbx",
                             "bad/empty.obj",
                             "bad/vertices-only.obj",
                             "bad/header-only.ply",
                             "bad/huge-count.ply",
                             "bad/random-bytes.stl",
                             "bad/torus-double-sided.obj",
                             "bad/spot-30pct-flipped.obj",
                             "bad/spot-t-junctions.obj",
                             "bad/one-triangle.stl",
                             "bad/ico4-flattened.obj",
                             "elephant-with-holes.off",
                             "moebius.obj",
                             "NOTICE.md"}) {
        SCOPED_TRACE(name);
        expectRefused({"shatter", support::sharedMesh(name).string(), "--sites", "3"}, 2);
    }
}

TEST_F(Cli, OddButSoundFilesAreNotRefused) {
    SKIP_WITHOUT_MESHES();
    for (const char* name :
         {"bad/gearwheel-solid-header.stl", "bad/spot-bigendian-double.ply", "bad/torus-collinear-triangles.obj",
          "bad/torus-scale-1e-6.obj", "bad/trefoil-scale-1e7.obj", "bad/couplingdown-offset-1e6.off",
          "bad/hollow-ico4-wall-2pct.obj", "bad/torus-stray-vertices.obj", "bad/l-prism-concave-ngons.obj"}) {
        const Outcome run = runProgram(
            "brittle", {"shatter", support::sharedMesh(name).string(), "-o", path("a.glb"), "--sites", "5", "--verify"});
        EXPECT_EQ(run.exit_code, 0) << name << ": " << run.err;
    }
}

constexpr const char* kOpenBox = "OFF\n8 10 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n"
                                 "3 0 2 1\n3 0 3 2\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";

TEST_F(Cli, DoctorSaysWhereEverythingIs) {
    std::ofstream(path("box.off")) << kOpenBox;
    const Outcome text = runProgram("brittle", {"doctor", path("box.off")});
    EXPECT_EQ(text.exit_code, 2);
    EXPECT_NE(text.out.find("4 edges, 8 around, 2.82843 across, at (1, 1, 2)"), std::string::npos) << text.out;
    EXPECT_NE(text.err.find("or try --repair"), std::string::npos) << text.err;
    const Outcome run = runProgram("brittle", {"doctor", path("box.off"), "--json"});
    EXPECT_EQ(run.exit_code, 2);
    const nlohmann::json report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["sound"], false);
    for (const char* key : {"problems", "vertices", "triangles", "volume", "area", "diagonal", "center", "notes",
                            "reader_notes", "edges", "crossings", "slivers", "nonmanifold_edges_at", "nonmanifold_vertices_at",
                            "inconsistent_edges_at", "folds_at", "duplicate_triangles_at"})
        EXPECT_TRUE(report.contains(key)) << key;
    ASSERT_EQ(report["holes"].size(), 1u);
    EXPECT_EQ(report["holes"][0]["edges"], 4);
    EXPECT_EQ(report["holes"][0]["where"], (std::vector<double>{1, 1, 2}));
    ASSERT_EQ(report["parts"].size(), 1u);
    EXPECT_EQ(report["parts"][0]["genus"], 0);
    EXPECT_EQ(report["parts"][0]["rims"], 1);
    EXPECT_FALSE(report.contains("mended"));
}

TEST_F(Cli, DoctorMendsAndWritesTheMendedModel) {
    std::ofstream(path("box.off")) << kOpenBox;
    for (const char* name : {"mended.obj", "mended.off", "mended.ply"}) {
        const Outcome run = runProgram("brittle", {"doctor", path("box.off"), "--repair", "--json", "-o", path(name)});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err, "brittle: " + path("box.off") + ": mended: 1 hole closed at (1, 1, 2)\n");
        const nlohmann::json report = nlohmann::json::parse(run.out);
        EXPECT_EQ(report["sound"], true);
        EXPECT_EQ(report["mended"]["closed_holes"]["count"], 1);
        EXPECT_EQ(report["mended"]["closed_holes"]["holes"][0]["where"], (std::vector<double>{1, 1, 2}));
        const Outcome again = runProgram("brittle", {"doctor", path(name), "--json"});
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_NEAR(nlohmann::json::parse(again.out)["volume"].get<double>(), 8, 1e-6);
    }
}

TEST_F(Cli, DoctorWritesNothingItShouldNot) {
    std::ofstream(path("box.off")) << kOpenBox;
    std::ofstream(path("one.off")) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::vector<std::vector<std::string>> runs = {
        {path("box.off"), "-o", path("a.obj")},                         // not asked to mend
        {path("box.off"), "--repair", "-o", path("box.off")},           // its input
        {path("box.off"), "--repair", "-o", path("a.stl")},             // a format that is not written
        {path("box.off"), "--repair", "-o", path("no/such/place.obj")}, // a place where nothing can be
        {path("one.off"), "--repair", "-o", path("a.obj")}};            // cannot be mended
    for (std::vector<std::string> arguments : runs) {
        arguments.insert(arguments.begin(), "doctor");
        const Outcome run = runProgram("brittle", arguments);
        EXPECT_EQ(run.exit_code, 2) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_EQ(fileBytes(path("box.off")), kOpenBox);
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("")), {}), 2);
    }
}

TEST_F(Cli, DoctorTellsSoundFromBroken) {
    EXPECT_EQ(runProgram("brittle", {"doctor", "builtin:ring"}).exit_code, 0);
    SKIP_WITHOUT_MESHES();
    EXPECT_EQ(runProgram("brittle", {"doctor", support::sharedMesh("moebius.obj").string()}).exit_code, 2);
}

} // namespace
