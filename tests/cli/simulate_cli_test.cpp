// brittle simulate as its users meet it: the same numbers every time, files that hold what the world did, nothing left where
// something is wrong.
#include "tests/reference/motion_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/process.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/wait.h>

namespace {

using support::fileBytes;
using support::Outcome;
using support::runProgram;

constexpr size_t kFilmWidth = 160, kFilmHeight = 90;

class SimulateCli : public support::FolderTest {
protected:
    std::set<std::string> files() const {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder()))
            names.insert(entry.path().filename().string());
        return names;
    }
    static Outcome simulate(std::vector<std::string> arguments, const std::vector<std::string>& environment = {}) {
        arguments.insert(arguments.begin(), "simulate");
        return runProgram("brittle", arguments, environment);
    }
    static void expectRefused(const Outcome& run, int exit_code, const std::string& holds) {
        EXPECT_EQ(run.exit_code, exit_code) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_NE(run.err.find(holds), std::string::npos) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
    }
    // A box that falls, seen in small pictures.
    std::string smallScene() const {
        std::ofstream(path("small.toml")) << "name = \"small\"\n[camera]\nwidth = " << kFilmWidth
                                          << "\nheight = " << kFilmHeight
                                          << "\n[[body]]\nname = \"box\"\nplace = [0, 1.5, 0]\nspin = [1, 2, 3]\n"
                                             "[[collider]]\nname = \"ground\"\n";
        return path("small.toml");
    }
    // A ball of glass, 20 cm above the ground.
    std::string thrownBall(bool breaks, const std::string& pattern = "impact") const {
        std::ofstream(path("ball.toml")) << "name = \"ball\"\neffects = [\"gravity\", \"contacts\", \"friction\""
                                         << (breaks ? ", \"impact_fracture\"" : "")
                                         << "]\n[camera]\nwidth = 160\nheight = 90\neye = [0.5, 0.5, 1]\ntarget = [0, 0.1, 0]\n"
                                            "[[body]]\nname = \"ball\"\nshape = \"ball\"\nradius = 0.1\nplace = [0, 0.3, 0]\n"
                                            "velocity = [0, -6, 0]\nmaterial = \"glass\"\nbreak_pattern = \""
                                         << pattern << "\"\n[[collider]]\nname = \"ground\"\n";
        return path("ball.toml");
    }
    // A program that is found as ffmpeg.
    std::string fakeFfmpeg(const std::string& script) const {
        std::filesystem::create_directories(folder() / "bin");
        const std::string name = path("bin/ffmpeg");
        std::ofstream(name) << "#!/bin/sh\n" << script << "\n";
        std::filesystem::permissions(name, std::filesystem::perms::owner_all);
        return "PATH=" + path("bin");
    }
};

bool isHash(const std::string& line) {
    return line.size() == 17 && line[16] == '\n' &&
           std::all_of(line.begin(), line.end() - 1, [](unsigned char c) { return std::isxdigit(c) && !std::isupper(c); });
}

TEST_F(SimulateCli, TheHashIsTheSameWhateverTheThreadsAndWorkgroups) {
    const auto hash = [&](std::vector<std::string> more, const std::vector<std::string>& environment) {
        more.insert(more.begin(), {"hull_pile_100", "--state-hash"});
        if (std::ranges::find(more, "--seconds") == more.end()) more.insert(more.end(), {"--seconds", "0.5"});
        const Outcome run = simulate(more, environment);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return run.out;
    };
    const std::string usual = hash({}, {});
    EXPECT_TRUE(isHash(usual)) << usual;
    EXPECT_EQ(hash({}, {}), usual);
    EXPECT_EQ(hash({"--group-size", "16"}, {}), usual);
    EXPECT_EQ(hash({}, {"LP_NUM_THREADS=1"}), usual);
    EXPECT_EQ(hash({"-o", path("pile.glb"), "--fps", "7"}, {}), usual); // looking at it changes nothing
    EXPECT_NE(hash({"--seconds", "0.4"}, {}), usual);
}

TEST_F(SimulateCli, ReportsWhatItDid) {
    const Outcome run = simulate({"card_house", "--seconds", "0.2", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    support::SceneRun expected("card_house");
    expected.step(report["steps"].get<uint32_t>());
    EXPECT_EQ(report["scene"], "card_house");
    EXPECT_EQ(report["steps"], std::lround(0.2 / expected.scene().step.dt));
    EXPECT_EQ(report["bodies"], expected.bodyCount() - 1);
    EXPECT_EQ(report["colliders"], 1);
    EXPECT_EQ(report["frames"], 0);
    EXPECT_NEAR(report["kinetic_energy"].get<double>(), expected.kineticEnergy(), 1e-9 + 1e-6 * expected.kineticEnergy());
    EXPECT_GT(report["pairs"].get<int>(), 15);
    EXPECT_GT(report["contacts"].get<int>(), 15);
    EXPECT_GT(report["dispatches_per_step"].get<int>(), 10);
    EXPECT_GT(report["ms_per_step"]["median"].get<double>(), 0);
    EXPECT_LE(report["ms_per_step"]["median"], report["ms_per_step"]["p99"]);
    double shares = 0;
    for (const auto& [stage, share] : report["stages"].items())
        shares += share.get<double>();
    EXPECT_NEAR(shares, 1, 1e-9);
    char hash[17];
    std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(*expected.world().hash()));
    EXPECT_EQ(report["state_hash"], hash);
}

TEST_F(SimulateCli, TheAnimationIsWhatTheWorldDid) {
    const Outcome run = simulate({"card_house", "-o", path("house.glb"), "--seconds", "0.5"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const reference::MotionFile file = reference::readMotionFile(path("house.glb"));
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    support::SceneRun expected("card_house");
    ASSERT_EQ(file.bodies.size(), expected.bodyCount());
    const auto expectKeys = [&](size_t key) {
        for (size_t b = 0; b < file.bodies.size(); ++b)
            for (size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(file.origin[k] + file.bodies[b].places[key][k], expected.place(b)[k], 1e-6) << b << " at " << key;
    };
    expectKeys(0);
    expected.step(static_cast<uint32_t>(std::lround(0.5 / expected.scene().step.dt)));
    expectKeys(file.times.size() - 1);
    EXPECT_NEAR(file.times.back(), 0.5, 1e-6);
    EXPECT_FALSE(file.body("ground").moves);
}

TEST_F(SimulateCli, FramesBetweenStepsLieBetweenTheirStates) {
    const Outcome run = simulate({smallScene(), "-o", path("a.glb"), "--seconds", "0.1", "--fps", "60"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    ASSERT_EQ(simulate({smallScene(), "-o", path("b.glb"), "--seconds", "0.1", "--fps", "45"}).exit_code, 0);
    const reference::MotionFile steps = reference::readMotionFile(path("a.glb")),
                                frames = reference::readMotionFile(path("b.glb"));
    ASSERT_EQ(steps.times.size(), 7u);
    ASSERT_EQ(frames.times.size(), 6u); // five on the way, and the last moment
    EXPECT_NEAR(frames.times.back(), 0.1, 1e-6);
    for (size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(frames.times[k], static_cast<double>(k) / 45, 1e-6);
        const double at = static_cast<double>(k) * 60 / 45;
        const auto before = static_cast<size_t>(at);
        const double share = at - static_cast<double>(before);
        const reference::Point a = steps.body("box").places[before], b = steps.body("box").places[before + 1];
        EXPECT_NEAR(frames.body("box").places[k][1], (1 - share) * a[1] + share * b[1], 1e-6) << k;
    }
    EXPECT_EQ(frames.body("box").places.back(), steps.body("box").places.back());
}

TEST_F(SimulateCli, ABallThatBreaksGivesWayToItsFragments) {
    const Outcome run = simulate({thrownBall(true), "-o", path("a.glb"), "--seconds", "0.1", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    const size_t fragments = report["fragments"];
    EXPECT_GT(fragments, 2u);
    EXPECT_EQ(report["bodies"], 1);
    EXPECT_EQ(report["broken"], 1);
    EXPECT_EQ(report["bodies_at_end"], fragments);
    EXPECT_EQ(report["colliders"], 1);
    const reference::MotionFile file = reference::readMotionFile(path("a.glb"));
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    ASSERT_EQ(file.bodies.size(), 2 + fragments);
    EXPECT_EQ(file.meshes, 2 + fragments);
    const reference::MovingBody& ball = file.body("ball");
    const size_t breaks = ball.timesSeen();
    EXPECT_GT(breaks, 0u);
    EXPECT_EQ(ball.firstSeen(), 0u);
    const double volume = reference::volumeOf(ball.outer);
    double sum = 0;
    for (const reference::MovingBody& fragment : file.bodies) {
        if (!fragment.name.starts_with("ball/")) continue;
        EXPECT_EQ(fragment.firstSeen(), breaks);
        EXPECT_EQ(fragment.timesSeen(), file.times.size() - breaks);
        EXPECT_FALSE(fragment.inner.empty());
        reference::Triangles all = fragment.outer;
        all.insert(all.end(), fragment.inner.begin(), fragment.inner.end());
        sum += reference::volumeOf(all);
    }
    EXPECT_NEAR(sum, volume, 1e-4 * volume);
}

// A ball of concrete, between the ground and a block of steel; its fragments break again while the block comes down on them.
TEST_F(SimulateCli, BreaksBodiesInThePatternThatTheSceneSays) {
    std::set<std::string> hashes;
    for (const char* pattern : {"impact", "uniform", "paper"}) {
        const Outcome run = simulate({thrownBall(true, pattern), "--seconds", "0.1", "--json"});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const auto told = nlohmann::json::parse(run.out);
        EXPECT_EQ(told["broken"], 1) << told.dump(1);
        hashes.insert(told["state_hash"].dump());
    }
    EXPECT_EQ(hashes.size(), 3u);
}

TEST_F(SimulateCli, SaysWhatBrokeByWhatAndWhatStayedWhole) {
    std::ofstream(path("told.toml")) << "name = \"told\"\neffects = [\"gravity\", \"impact_fracture\", \"events\"]\n"
                                        "[budgets]\nfragment_triangles = 3000\nmost_fragments = 60\n"
                                        "[[body]]\nname = \"first\"\nshape = \"ball\"\nradius = 0.1\nplace = [0, 0.3, 0]\n"
                                        "velocity = [0, -9, 0]\nmaterial = \"glass\"\n"
                                        "[[body]]\nname = \"second\"\nshape = \"ball\"\nradius = 0.1\nplace = [2, 0.3, 0]\n"
                                        "velocity = [0, -9, 0]\nmaterial = \"glass\"\n[[collider]]\nname = \"ground\"\n";
    const Outcome run = simulate({path("told.toml"), "--seconds", "0.1", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json breaks = nlohmann::json::parse(run.out)["breaks"];
    ASSERT_EQ(breaks.size(), 2u) << breaks;
    EXPECT_EQ(breaks[0]["body"], "first");
    EXPECT_EQ(breaks[0]["hit_by"], "ground");
    EXPECT_EQ(breaks[0]["material"], "glass");
    EXPECT_GT(breaks[0]["fragments_paid_for"], 60u) << "more than the budget of one body has room for";
    EXPECT_LT(breaks[0]["smallest_mass"], breaks[0]["largest_mass"]);
    EXPECT_GT(breaks[0]["fragments"], 20u);
    EXPECT_GT(breaks[0]["crack_area"], 0.0);
    EXPECT_NEAR(double{breaks[0]["place"][1]}, 0, 0.02);
    EXPECT_NEAR(double{breaks[1]["place"][0]}, 2, 0.02);
    EXPECT_EQ(breaks[1]["body"], "second");
    EXPECT_EQ(breaks[1]["fragments"], 0u);
    EXPECT_EQ(breaks[1]["whole"], "no room in the world");
    EXPECT_GT(breaks[1]["lacked"]["triangles"], 0u);
    const Outcome told = simulate({path("told.toml"), "--seconds", "0.1", "-o", path("a.glb")});
    ASSERT_EQ(told.exit_code, 0) << told.err;
    EXPECT_NE(told.out.find("first by ground at 9"), std::string::npos) << told.out;
    EXPECT_NE(told.out.find("whole: no room in the world, lacked "), std::string::npos) << told.out;
}

TEST_F(SimulateCli, NothingIsMissingWhileFragmentsBreakAgain) {
    std::ofstream(path("twice.toml"))
        << "name = \"twice\"\neffects = [\"contacts\", \"impact_fracture\", \"refracture\", \"events\"]\n"
           "[[body]]\nname = \"ball\"\nshape = \"ball\"\nradius = 0.3\nplace = [0, 0.5, 0]\n"
           "velocity = [0, -12, 0]\nmaterial = \"concrete\"\n"
           "[[body]]\nname = \"block\"\nsize = [0.5, 0.5, 0.5]\nplace = [0, 2.5, 0]\n"
           "velocity = [0, -12, 0]\ndensity = 7800\n[[collider]]\nname = \"ground\"\n";
    const Outcome run = simulate({path("twice.toml"), "-o", path("a.glb"), "--seconds", "0.17", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const nlohmann::json report = nlohmann::json::parse(run.out);
    const size_t broken = report["broken"], fragments = report["fragments"];
    EXPECT_GT(broken, 1u);
    EXPECT_EQ(report["bodies_at_end"], 2 + fragments - broken);
    const reference::MotionFile file = reference::readMotionFile(path("a.glb"));
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    EXPECT_EQ(file.bodies.size(), 3 + fragments); // each is seen at a step at least
    EXPECT_EQ(std::ranges::count_if(file.bodies, [](const auto& body) { return !body.there.back(); }), broken);
    std::set<std::string> seen, told;
    for (const reference::MovingBody& body : file.bodies)
        EXPECT_TRUE(seen.insert(body.name).second) << "two go by the name " << body.name;
    for (const auto& event : report["breaks"])
        told.insert({event["body"], event["hit_by"]});
    for (const auto& event : report["impacts"])
        told.insert({event["bodies"][0], event["bodies"][1]});
    EXPECT_GT(told.size(), 5u);
    EXPECT_TRUE(std::ranges::includes(seen, told)) << "events name bodies as the animation does";
    std::vector<double> volumes(file.times.size());
    for (const reference::MovingBody& body : file.bodies) {
        reference::Triangles all = body.outer;
        all.insert(all.end(), body.inner.begin(), body.inner.end());
        for (size_t k = 0; k < volumes.size(); ++k)
            if (body.there[k]) volumes[k] += reference::volumeOf(all);
    }
    for (const double volume : volumes)
        EXPECT_NEAR(volume, volumes[0], 1e-4 * volumes[0]);
}

TEST_F(SimulateCli, PicturesShowWhatIsLeftOfABall) {
    ASSERT_EQ(simulate({thrownBall(true), "-o", path("broken.png"), "--seconds", "0.1"}).exit_code, 0);
    ASSERT_EQ(simulate({thrownBall(false), "-o", path("whole.png"), "--seconds", "0.1"}).exit_code, 0);
    EXPECT_FALSE(fileBytes(path("broken.png")) == fileBytes(path("whole.png")));
    ASSERT_EQ(simulate({thrownBall(true), "-o", path("all_%d.png"), "--seconds", "0.1", "--fps", "20"}).exit_code, 0);
    EXPECT_TRUE(fileBytes(path("all_2.png")) == fileBytes(path("broken.png"))); // however the bodies came to be there
}

TEST_F(SimulateCli, WhereNothingBreaksFilesAreAsWithoutTheEffect) {
    for (const char* ending : {"glb", "png"}) {
        const std::string with = path(std::string("with.") + ending), without = path(std::string("without.") + ending);
        ASSERT_EQ(simulate({thrownBall(true), "-o", with, "--seconds", "0.01"}).exit_code, 0);
        ASSERT_EQ(simulate({thrownBall(false), "-o", without, "--seconds", "0.01"}).exit_code, 0);
        EXPECT_TRUE(fileBytes(with) == fileBytes(without)) << ending;
    }
}

TEST_F(SimulateCli, TheSameFileTwice) {
    for (const char* name : {"a.glb", "b.glb"})
        ASSERT_EQ(simulate({"stack_10", "-o", path(name), "--seconds", "0.2"}).exit_code, 0);
    EXPECT_TRUE(fileBytes(path("a.glb")) == fileBytes(path("b.glb")));
}

TEST_F(SimulateCli, PicturesOfTheLastMomentOrOfEveryFrame) {
    ASSERT_EQ(simulate({smallScene(), "-o", path("last.png"), "--seconds", "0.2"}).exit_code, 0);
    ASSERT_EQ(simulate({smallScene(), "-o", path("fall_%03d.png"), "--seconds", "0.2", "--fps", "10"}).exit_code, 0);
    EXPECT_EQ(files(), (std::set<std::string>{"small.toml", "last.png", "fall_000.png", "fall_001.png", "fall_002.png"}));
    expectRefused(simulate({smallScene(), "-o", path("fall_%s.png"), "--seconds", "0.2"}), 2, "write %d or %04d");
    EXPECT_EQ(fileBytes(path("last.png")).substr(1, 3), "PNG");
    EXPECT_TRUE(fileBytes(path("fall_002.png")) == fileBytes(path("last.png")));
    EXPECT_FALSE(fileBytes(path("fall_000.png")) == fileBytes(path("last.png")));
}

TEST_F(SimulateCli, FilmsAreGivenEveryFrameWhole) {
    const std::string path_setting = fakeFfmpeg("for last; do :; done; /bin/cat > \"${last#file:}\"");
    const Outcome run = simulate({smallScene(), "-o", path("fall.mp4"), "--seconds", "0.2", "--fps", "20"}, {path_setting});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string film = fileBytes(path("fall.mp4"));
    const size_t frame = 3 * kFilmWidth * kFilmHeight;
    ASSERT_EQ(film.size(), 5 * frame);
    EXPECT_FALSE(film.substr(0, frame) == film.substr(4 * frame));
    EXPECT_EQ(files(), (std::set<std::string>{"small.toml", "bin", "fall.mp4"}));
}

TEST_F(SimulateCli, FilmsOpenInPlayers) {
    if (std::system("command -v ffmpeg ffprobe >/dev/null") != 0) GTEST_SKIP() << "no ffmpeg";
    ASSERT_EQ(simulate({smallScene(), "-o", path("fall.mp4"), "--seconds", "0.2", "--fps", "20"}).exit_code, 0);
    const std::string probe = "ffprobe -v error -count_frames -show_entries stream=nb_read_frames,width,height -of csv=p=0 '" +
                              path("fall.mp4") + "' > '" + path("probe.txt") + "'";
    ASSERT_EQ(std::system(probe.c_str()), 0);
    EXPECT_EQ(fileBytes(path("probe.txt")), "160,90,5\n");
}

TEST_F(SimulateCli, AFilmWithoutFfmpegNamesThePackage) {
    expectRefused(simulate({smallScene(), "-o", path("fall.mp4")}, {"PATH=" + path("nothing")}), 2,
                  "install the package ffmpeg");
    expectRefused(simulate({smallScene(), "-o", path("fall.mp4")}, {"PATH="}), 2, "install the package ffmpeg");
    EXPECT_EQ(files(), (std::set<std::string>{"small.toml"}));
}

TEST_F(SimulateCli, AFilmThatFailsLeavesNothingBehind) {
    expectRefused(simulate({smallScene(), "-o", path("fall.mp4")}, {fakeFfmpeg("echo no room left >&2; exit 1")}), 2,
                  "no room left");
    expectRefused(
        simulate({smallScene(), "-o", path("fall.mp4"), "--seconds", "0.1"}, {fakeFfmpeg("/bin/cat >/dev/null; exit 3")}), 2,
        "status 3");
    expectRefused(simulate({smallScene(), "-o", path("fall.mp4")}, {fakeFfmpeg("kill -9 $$")}), 2, "signal 9");
    EXPECT_EQ(files(), (std::set<std::string>{"small.toml", "bin"}));
}

TEST_F(SimulateCli, HasToBeAskedForSomething) { expectRefused(simulate({"stack_10"}), 2, "give -o, --json or --state-hash"); }

// `timeout` sends the signal once the run has made its first steps.
TEST_F(SimulateCli, LeavesNothingBehindWhereItIsInterrupted) {
    const std::string program = std::string(BRITTLE_BINARY_DIR) + "/brittle", scene = smallScene();
    for (const char* signal : {"INT", "TERM"})
        for (const char* output : {"a.glb", "a_%04d.png"}) {
            const std::string command = "timeout --preserve-status -s " + std::string(signal) + " 1.5 " + program +
                                        " simulate " + scene + " --seconds 10000 -o " + path(output) + " 2>/dev/null";
            const int status = std::system(command.c_str());
            EXPECT_EQ(WEXITSTATUS(status), 128 + (signal == std::string("INT") ? SIGINT : SIGTERM));
            EXPECT_EQ(files(), std::set<std::string>{"small.toml"}) << signal << " " << output;
        }
}

// A square with a corner that two triangles share and one that has collapsed to a line.
TEST_F(SimulateCli, TakesCollidersWithTrianglesWithoutArea) {
    std::ofstream(path("floor.obj")) << "v -5 0 -5\nv 5 0 -5\nv 5 0 5\nv -5 0 5\nv 0 0 0\nf 1 3 2\nf 1 4 3\nf 1 5 3\n";
    std::ofstream(path("floor.toml")) << "name = \"floor\"\n[[body]]\nplace = [1, 0.6, 0.5]\n"
                                         "[[collider]]\nshape = \"mesh\"\nfile = \"floor.obj\"\n";
    const Outcome run = simulate({path("floor.toml"), "--seconds", "1", "--state-hash"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(SimulateCli, RefusesBodiesWhoseModelsAreOpen) {
    std::ofstream(path("open.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"; // no fourth side
    std::ofstream(path("open.toml")) << "name = \"open\"\n[[body]]\nname = \"tent\"\nshape = \"mesh\"\nfile = \"open.obj\"\n"
                                        "sites = 5\n";
    expectRefused(simulate({path("open.toml"), "--seconds", "1", "--state-hash"}), 2, "open.obj: 3 open edges");
}

TEST_F(SimulateCli, RefusesWhatIsWrongInOneLine) {
    expectRefused(simulate({"card_hous", "--json"}), 2, "did you mean 'card_house'?");
    expectRefused(simulate({path("none.toml"), "--json"}), 2, "no such file");
    expectRefused(simulate({"stack_10", "-o", path("a.mp5")}), 2, ".glb, .png and .mp4");
    expectRefused(simulate({"stack_10", "-o", path("a_%04d.glb")}), 2, "only pictures are numbered");
    expectRefused(simulate({"stack_10", "-o", path("no/folder.glb")}), 2, "cannot be written");
    expectRefused(simulate({"stack_10", "-o", path("no/folder()%d.png")}), 2, "cannot be written");
    expectRefused(simulate({"stack_10", "-o", path("a.glb"), "--seconds", "nan"}), 2, "--seconds");
    expectRefused(simulate({"stack_10", "-o", path("a.glb"), "--fps", "0"}), 2, "--fps");
    expectRefused(simulate({"stack_10", "-o", path("a.glb"), "--seconds", "1e4", "--fps", "1000"}), 2, "a million frames");
    expectRefused(simulate({"stack_10", "--json", "--seconds", "1e9"}), 2, "--seconds");
    expectRefused(simulate({"stack_10", "--json", "--fps", "30"}), 2, "--fps");
    expectRefused(simulate({"stack_10", "--json", "--state-hash"}), 2, "--state-hash");
    std::ofstream(path("bad.toml")) << "[[body]]\nplace = [0, nan, 0]\n";
    expectRefused(simulate({path("bad.toml"), "-o", path("a.glb")}), 2, "bad.toml:2");
    EXPECT_EQ(files(), (std::set<std::string>{"bad.toml"}));
}

TEST_F(SimulateCli, DoesNotWriteOverWhatItReads) {
    std::filesystem::create_symlink(smallScene(), path("link.glb"));
    const std::string before = fileBytes(path("small.toml"));
    expectRefused(simulate({path("small.toml"), "-o", path("link.glb")}), 2, "would be overwritten");
    EXPECT_EQ(fileBytes(path("small.toml")), before);
}

TEST_F(SimulateCli, TooSmallABudgetIsNamed) {
    expectRefused(simulate({"hard_24_overflow", "-o", path("a.glb")}), 3, "see [budgets] in the scene");
    expectRefused(simulate({"hard_24_overflow", "-o", path("a_%d.png")}), 3, "pairs");
    EXPECT_TRUE(files().empty());
}

// A block of glass that becomes dust on the ground.
constexpr const char* kDustyScene = R"(name = "dusty"
effects = ["gravity", "contacts", "dust"]
[breaking]
smallest_piece = 1
[camera]
eye = [0, 0.3, 1]
target = [0, 0.1, 0]
width = 320
height = 240
[[body]]
material = "glass"
size = [0.1, 0.1, 0.1]
place = [0, 0.06, 0]
velocity = [0, -12, 0]
[[collider]]
)";

TEST_F(SimulateCli, TellsOfDustAndDrawsIt) {
    std::ofstream(path("dusty.toml")) << kDustyScene;
    const Outcome run = simulate({path("dusty.toml"), "--seconds", "0.1", "--json", "-o", path("with.png")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto dust = nlohmann::json::parse(run.out)["dust"];
    EXPECT_GT(dust["made"]["particles"], 10);
    EXPECT_NEAR(dust["made"]["mass"].get<double>(), 2.5, 1e-5) << "all of the block";
    EXPECT_EQ(dust["flying"], dust["made"]);
    EXPECT_EQ(dust["overwritten"]["particles"], 0);
    std::ofstream(path("without.toml")) << std::string(kDustyScene) + "[dust]\nlifetime = 0\n";
    ASSERT_EQ(simulate({path("without.toml"), "--seconds", "0.1", "-o", path("without.png")}).exit_code, 0);
    EXPECT_NE(support::fileBytes(path("with.png")), support::fileBytes(path("without.png")));
}

TEST_F(SimulateCli, WithoutDustThereIsNothingToTellOfIt) {
    const Outcome run = simulate({smallScene(), "--seconds", "0.1", "--json"});
    EXPECT_TRUE(nlohmann::json::parse(run.out)["dust"].is_null());
}

TEST_F(SimulateCli, NoStepsAreTheBeginning) {
    ASSERT_EQ(simulate({smallScene(), "-o", path("a.glb"), "--seconds", "0"}).exit_code, 0);
    const reference::MotionFile file = reference::readMotionFile(path("a.glb"));
    EXPECT_EQ(file.times, (std::vector<double>{0}));
    EXPECT_NEAR(file.body("box").places[0][1], 1.5, 1e-6);
}

} // namespace
