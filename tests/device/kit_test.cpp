// The folder that tools/gpu_check.sh packs, in a root file system that holds nothing else but the kernel's own file systems and
// Mesa's lavapipe (kit_in_chroot.sh).
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>

namespace device_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kSource = BRITTLE_SOURCE_DIR;
const fs::path kBuild = fs::path(BRITTLE_BINARY_DIR).parent_path();
constexpr int kCannot = 77;

// Exit code; what the command prints goes to `log`.
int runShell(const std::string& command, const fs::path& log) {
    const int status =
        std::system((command + " >'" + log.string() + "' 2>&1").c_str()); // NOLINT(cert-env33-c): our own command
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class Kit : public testing::Test {
protected:
    static void SetUpTestSuite() {
        fs::remove_all(folder());
        fs::create_directories(folder());
        can_mount_ = runShell((kSource / "tests/device/kit_in_chroot.sh").string() + " --can-run", log()) != kCannot;
        if (!can_mount_) return;
        packed_ =
            runShell((kSource / "tools/gpu_check.sh").string() + " --no-build --small -o '" + kit().string() + "'", log()) == 0;
    }
    void SetUp() override {
        if (!can_mount_) GTEST_SKIP() << "no file systems can be mounted here, or Mesa's lavapipe is missing: " << said();
        ASSERT_TRUE(packed_) << said();
    }

    static fs::path folder() { return kBuild / "kit-test"; }
    static fs::path kit() { return folder() / "kit"; }
    static fs::path log() { return folder() / "log"; }
    static fs::path resultsFile() { return folder() / "root/kit/results.json"; }

    static int run(const std::string& words, const std::string& environment = "") {
        return runShell(environment + " " + (kSource / "tests/device/kit_in_chroot.sh").string() + " '" + kit().string() +
                            "' '" + folder().string() + "' " + words,
                        log());
    }
    static std::string said() { return support::fileBytes(log().string()); }
    static Json results(const fs::path& file = resultsFile()) {
        return Json::parse(support::fileBytes(file.string()), nullptr, /*allow_exceptions=*/false);
    }

    static bool can_mount_, packed_;
};
bool Kit::can_mount_ = false, Kit::packed_ = false;

void expectModelsAsExpected(const Json& part) {
    EXPECT_EQ(part["status"], "passed") << part.value("reason", "");
    ASSERT_EQ(part["models"].size(), 12u);
    for (const Json& line : part["models"])
        for (const char* what : {"topology_is", "positions_is", "attributes_is", "masses_is"})
            EXPECT_EQ(line.value(what, ""), "equal") << line;
}

void expectScenesAsExpected(const Json& part) {
    EXPECT_EQ(part["status"], "passed") << part.value("reason", "");
    ASSERT_EQ(part["scenes"].size(), 2u);
    for (const Json& line : part["scenes"]) {
        EXPECT_EQ(line.value("same_bits_twice", false), true) << line;
        EXPECT_EQ(line.value("hash_is", ""), "equal") << line;
    }
}

TEST_F(Kit, IsSmallAndHasAGuide) {
    uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kit()))
        if (entry.is_regular_file()) bytes += entry.file_size();
    EXPECT_LT(bytes, 55u << 20);
    EXPECT_NE(support::fileBytes((kit() / "README.txt").string()).find("./run.sh"), std::string::npos);
}

TEST_F(Kit, GivesInAnEmptyRootWhatThisMachineGives) {
    const int code = run("-o /kit --parts models scenes motion --limit-scale 8");
    EXPECT_EQ(code, 0) << said();
    const Json parts = results()["parts"];
    EXPECT_NE(parts["device"]["facts"]["name"].get<std::string>().find("llvmpipe"), std::string::npos);
    expectModelsAsExpected(parts["models"]);
    expectScenesAsExpected(parts["scenes"]);
    EXPECT_EQ(parts["motion"]["status"], "passed") << parts["motion"].value("reason", "");
    ASSERT_EQ(parts["motion"]["scenes"].size(), 3u);
    for (const Json& scene : parts["motion"]["scenes"])
        EXPECT_TRUE(scene["agree"].get<bool>()) << scene["scene"];
    EXPECT_GT(support::fileBytes((folder() / "root/kit/results.html").string()).size(), 10'000u);
    EXPECT_EQ(results()["compiled_kernels"], "empty at the beginning");
    EXPECT_FALSE(fs::is_empty(folder() / "root/kit/compiled"));
}

// A second run finds what the first one unpacked, and its time limit: tests that did not run are counted, and no test fails.
TEST_F(Kit, RunsAgainAndStopsAtItsTimeLimit) {
    const int code = run("-o /kit --parts kernels --limit-scale 0.2");
    EXPECT_EQ(code, 0) << said();
    const Json part = results()["parts"]["kernels"];
    const Json tests = part["programs"]["kernel"];
    EXPECT_GT(tests["passed"].get<int>(), 0);
    EXPECT_EQ(tests["passed"].get<int>() + tests["not run"].get<int>() + tests["skipped"].get<int>(),
              tests["tests"].get<int>());
    EXPECT_LT(part["seconds"].get<double>(), 0.2 * 350 + 5);
    EXPECT_EQ(results()["compiled_kernels"], "filled by an earlier check");
    EXPECT_TRUE(results(folder() / "root/kit/results.json.1")["parts"].contains("models")) << said();
    EXPECT_NE(said().find("These parts were not checked, or not wholly: kernels"), std::string::npos) << said();
}

fs::path unpacked() {
    for (const auto& entry : fs::directory_iterator(kBuild / "kit-test/root/kit"))
        if (entry.path().filename().string().starts_with("unpacked-")) return entry.path();
    ADD_FAILURE() << "nothing is unpacked";
    return {};
}

// A model, a test program and the expected results: only some parts read them.
TEST_F(Kit, UnpacksAgainIfAFileIsDamaged) {
    run("--help");
    for (const char* file : {"expected.json", "bin/brittle_tests_kernel", "source/README.md"}) {
        const auto whole = fs::file_size(unpacked() / file);
        fs::resize_file(unpacked() / file, 100);
        EXPECT_EQ(run("-o /kit/repaired --parts device"), 0) << said();
        EXPECT_NE(said().find(std::string(file) + " is damaged"), std::string::npos) << said();
        EXPECT_EQ(fs::file_size(unpacked() / file), whole);
    }
}

TEST_F(Kit, GoesOnWithoutAReaderAndKeepsItsResults) {
    run("-o /kit --parts motion | head -c 1");
    EXPECT_TRUE(results()["parts"].contains("motion")) << said();
}

TEST_F(Kit, TellsThatADiskIsFullAndKeepsWhatWasWritten) {
    fs::remove_all(folder() / "root/kept");
    run("-o /kit/results --parts models", "KIT_RESULTS_SIZE=24k");
    EXPECT_NE(said().find("the earlier file stays"), std::string::npos) << said();
    EXPECT_TRUE(results(folder() / "root/kept/results.json")["parts"].contains("device")) << said();
}

TEST_F(Kit, SaysThatThereIsNoDevice) {
    const int code = run("-o /kit", "VK_DRIVER_FILES=/nowhere");
    EXPECT_EQ(code, 4) << said();
    EXPECT_NE(said().find("no Vulkan device can be used"), std::string::npos) << said();
}

} // namespace
} // namespace device_test
