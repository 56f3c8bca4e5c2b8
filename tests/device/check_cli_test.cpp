// brittle check-device on folders that lack most of a kit.
#include "tests/support/folder_test.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <thread>

namespace device_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using support::Outcome;

// A kit with brittle and a test program that hangs (fake_tests.sh). Its name has characters that JSON writes in another way.
class CheckCli : public support::FolderTest {
protected:
    void SetUp() override {
        FolderTest::SetUp();
        fs::create_directories(kit() / "bin");
        fs::create_symlink(std::string(BRITTLE_BINARY_DIR) + "/brittle", kit() / "bin/brittle");
    }
    void addTests(const std::string& name) const {
        fs::copy_file(fs::path(BRITTLE_SOURCE_DIR) / "tests/device/fake_tests.sh", kit() / "bin" / name);
    }
    // A program with one test, Fake.Passes. `script` stands for what it does when it runs.
    void writeTests(const std::string& script) const {
        const fs::path program = kit() / "bin/brittle_tests_kernel";
        std::ofstream(program) << "#!/bin/sh\ncase \"$*\" in *list_tests*) printf 'Fake.\\n  Passes\\n'; exit ;; esac\n"
                               << script << "\n";
        fs::permissions(program, fs::perms::owner_all);
    }
    fs::path kit() const { return folder() / "a \"kit\" \\ here"; }
    std::vector<std::string> arguments(const std::vector<std::string>& options) const {
        std::vector<std::string> all = {"check-device", "--kit", kit().string(), "-o", path("out")};
        all.insert(all.end(), options.begin(), options.end());
        return all;
    }
    Outcome check(const std::vector<std::string>& options) const { return support::runProgram("brittle", arguments(options)); }
    Json results(const std::string& name = "results.json") const {
        return Json::parse(support::fileBytes(path("out/" + name)), nullptr, /*allow_exceptions=*/false);
    }
    bool hasScratch() const {
        for (const auto& entry : fs::directory_iterator(path("out")))
            if (entry.path().filename().string().starts_with("scratch-")) return true;
        return false;
    }
};

TEST_F(CheckCli, FailsAndSaysWhatIsMissing) {
    const Outcome run = check({"--parts", "kernels", "models", "motion"});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    const Json parts = results()["parts"];
    EXPECT_EQ(parts["kernels"]["status"], "failed");
    EXPECT_EQ(parts["kernels"]["reason"], "the tests of brittle_tests_kernel cannot be listed: the program is missing");
    EXPECT_EQ(parts["models"]["reason"], "nothing was compared: expected.json is missing");
    EXPECT_EQ(parts["motion"]["reason"], "nothing was compared: recordings are missing");
    EXPECT_EQ(results()["ended"], true);
    std::ofstream(kit() / "expected.json") << "{\"models\": [";
    EXPECT_EQ(check({"--parts", "models"}).exit_code, 1);
    EXPECT_EQ(results()["parts"]["models"]["reason"], "nothing was compared: expected.json is damaged");
}

TEST_F(CheckCli, HidesTheFolderWhateverItsName) {
    fs::create_directories(kit() / "recordings");
    std::ofstream(kit() / "recordings/stack_10.motion") << "no motion";
    std::ofstream(kit() / "expected.json") << R"({"models": [{}], "scenes": [{}]})";
    EXPECT_EQ(check({"--parts", "motion"}).exit_code, 1);
    const std::string reason = results()["parts"]["motion"]["reason"];
    EXPECT_NE(reason.find("KIT/recordings/stack_10.motion: is no recorded motion"), std::string::npos) << reason;
}

TEST_F(CheckCli, KeepsEarlierResults) {
    EXPECT_EQ(check({"--parts", "motion"}).exit_code, 1);
    EXPECT_EQ(check({"--parts", "motion", "--device", "no such card"}).exit_code, 4);
    EXPECT_TRUE(results()["parts"].contains("motion"));
    EXPECT_FALSE(fs::exists(path("out/results.json.1")));
    const Outcome run = check({"--parts", "models"});
    EXPECT_NE(run.out.find("are now in results.json.1 and results.html.1"), std::string::npos) << run.out;
    EXPECT_TRUE(results("results.json.1")["parts"].contains("motion"));
    EXPECT_FALSE(results()["parts"].contains("motion"));
}

TEST_F(CheckCli, LeavesSoundResultsAndNoFolderWhenInterrupted) {
    addTests("brittle_tests_kernel");
    support::RunningProgram run("brittle", arguments({"--parts", "motion", "kernels"}));
    for (int k = 0; k < 600 && !(fs::exists(path("out/results.json")) && results()["parts"].contains("device")); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(hasScratch());
    run.interrupt();
    const Outcome ended = run.wait();
    EXPECT_EQ(ended.exit_code, -1); // ended by the signal
    EXPECT_NE(ended.err.find("interrupted; the results of the parts that have ended are in"), std::string::npos) << ended.err;
    EXPECT_FALSE(hasScratch());
    EXPECT_EQ(results()["ended"], false);
    EXPECT_TRUE(results()["parts"].contains("device"));
}

TEST_F(CheckCli, NamesTheTestsThatWereNotReached) {
    addTests("brittle_tests_kernel");
    const Outcome run = check({"--parts", "kernels", "--limit-scale", "0.05"});
    const Json part = results()["parts"]["kernels"];
    EXPECT_EQ(part["of"], 5) << part;
    EXPECT_LT(part["done"], 5) << part;
    EXPECT_NE(run.out.find("These parts were not checked, or not wholly: kernels"), std::string::npos) << run.out;
}

TEST_F(CheckCli, IsNotDoneIfAllTestsSkipThemselves) {
    writeTests("echo '[ RUN      ] Fake.Passes'; echo '[  SKIPPED ] Fake.Passes (0 ms)'");
    const Outcome run = check({"--parts", "kernels"});
    const Json part = results()["parts"]["kernels"];
    EXPECT_EQ(part["status"], "skipped") << part;
    EXPECT_EQ(part["done"], 0) << part;
    EXPECT_NE(run.out.find("not wholly: kernels against their oracles (skipped)"), std::string::npos) << run.out;
}

TEST_F(CheckCli, FailsIfAProgramEndsBadlyBehindItsLastTest) {
    for (const char* ending : {"kill -SEGV $$", "exit 1"}) {
        writeTests("echo '[ RUN      ] Fake.Passes'; echo '[       OK ] Fake.Passes (0 ms)'; " + std::string(ending));
        EXPECT_EQ(check({"--parts", "kernels"}).exit_code, 1) << ending;
        const std::string reason = results()["parts"]["kernels"].value("reason", "");
        EXPECT_NE(reason.find("ended badly behind its last test"), std::string::npos) << reason;
    }
}

TEST_F(CheckCli, RunsAllTestsWhateverTheEnvironmentTellsGoogleTest) {
    writeTests("echo '[ RUN      ] Fake.Passes'; [ -z \"$GTEST_BRIEF\" ] && echo '[       OK ] Fake.Passes (0 ms)'");
    const Outcome run = support::runProgram("brittle", arguments({"--parts", "kernels"}), {"GTEST_BRIEF=1"});
    EXPECT_EQ(results()["parts"]["kernels"]["status"], "passed") << run.out;
}

TEST_F(CheckCli, GoesOnAfterAHangupThatIsIgnoredAsByNohup) {
    const std::string command = "trap '' HUP; '" BRITTLE_BINARY_DIR "/brittle' check-device --kit '" + kit().string() +
                                "' -o '" + path("out") + "' --parts motion >/dev/null & sleep 0.2; kill -HUP $!; wait $!";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1); // recordings are missing
    EXPECT_EQ(results()["ended"], true);
}

TEST_F(CheckCli, NamesAProgramWhoseTestsAreUnknown) {
    addTests("brittle_tests_engine");
    const Outcome run = check({"--parts", "programs", "--limit-scale", "0.05"});
    EXPECT_NE(run.out.find("2 programs with tests unknown"), std::string::npos) << run.out;
}

TEST_F(CheckCli, NoticesAListThatWasCutShort) {
    std::ofstream(kit() / "meshes.txt") << "cube builtin:cube\n";
    std::ofstream(kit() / "scenes.txt") << "stack_10\n";
    fs::create_directories(kit() / "recordings");
    std::ofstream(kit() / "recordings/house.motion");
    EXPECT_EQ(check({"--write-expected", (kit() / "expected.json").string()}).exit_code, 0);
    EXPECT_EQ(check({"--parts", "models", "scenes"}).exit_code, 0);
    std::ofstream(kit() / "meshes.txt") << "";
    std::ofstream(kit() / "scenes.txt") << "stack_10\nbounce\n";
    fs::rename(kit() / "recordings/house.motion", kit() / "recordings/other.motion");
    EXPECT_EQ(check({"--parts", "models", "scenes", "motion"}).exit_code, 1);
    const Json parts = results()["parts"];
    EXPECT_EQ(parts["models"]["reason"], "meshes.txt is missing");
    EXPECT_EQ(parts["scenes"]["reason"], "the list of scenes gives 2 scenes, expected.json has 1; copy the folder again");
    EXPECT_EQ(parts["motion"]["reason"], "recordings/house.motion is missing; copy the folder again");
}

TEST_F(CheckCli, DoesNotWriteWhereAnotherCheckDoes) {
    addTests("brittle_tests_kernel");
    support::RunningProgram first("brittle", arguments({"--parts", "kernels"}));
    for (int k = 0; k < 600 && !(fs::exists(path("out")) && hasScratch()); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const Outcome second = check({"--parts", "motion"});
    EXPECT_EQ(second.exit_code, 2) << second.out;
    EXPECT_NE(second.err.find("another check writes its results there now"), std::string::npos) << second.err;
    first.interrupt();
    first.wait();
    EXPECT_EQ(check({"--parts", "motion"}).exit_code, 1);
}

TEST_F(CheckCli, RemovesWhatAKilledCheckLeftAndNothingElse) {
    for (const char* name : {"out/scratch-AbCdEf", "out/scratch-thesis"})
        fs::create_directories(path(name));
    std::ofstream(path("out/scratch-AbCdEf/made_by_check_device"));
    check({"--parts", "motion"});
    EXPECT_FALSE(fs::exists(path("out/scratch-AbCdEf")));
    EXPECT_TRUE(fs::exists(path("out/scratch-thesis")));
}

// A copy of a driver is a second device of the same name.
TEST_F(CheckCli, TellsTwoDevicesOfOneNameApart) {
    const fs::path manifest = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json", driver = path("libvulkan_lvp2.so");
    const Json known = Json::parse(support::fileBytes(manifest.string()), nullptr, /*allow_exceptions=*/false);
    if (!known.is_object()) GTEST_SKIP() << "Mesa's lavapipe is not installed";
    Json second = known;
    fs::copy_file(known["ICD"]["library_path"].get<std::string>(), driver);
    second["ICD"]["library_path"] = driver.string();
    std::ofstream(path("second.json")) << second;
    const std::string both = manifest.string() + ":" + path("second.json");
    const Outcome run = support::runProgram("brittle", {"devices", "--device", "1", "--json"},
                                            {"VK_DRIVER_FILES=" + both, "VK_ICD_FILENAMES=" + both});
    const Json devices = Json::parse(run.out, nullptr, /*allow_exceptions=*/false);
    ASSERT_EQ(devices.size(), 2u) << run.out << run.err;
    EXPECT_EQ(devices[0]["name"], devices[1]["name"]);
    EXPECT_EQ(devices[0]["chosen"], false);
    EXPECT_EQ(devices[1]["chosen"], true);
}

} // namespace
} // namespace device_test
