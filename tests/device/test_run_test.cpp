// Test programs that crash, hang and fail, as a check of a device meets them.
#include "tests/support/folder_test.h"
#include "tools/device_check/test_run.h"

#include <csignal>
#include <fstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace device_test {
namespace {

using device_check::ChildEnd;
using device_check::Clock;
using device_check::Kit;
using device_check::TestEnd;
using device_check::TestRun;

class TestRuns : public support::FolderTest {
protected:
    void SetUp() override {
        FolderTest::SetUp();
        std::filesystem::create_directories(folder() / "bin");
        std::filesystem::copy_file(std::filesystem::path(BRITTLE_SOURCE_DIR) / "tests/device/fake_tests.sh",
                                   folder() / "bin/fake");
    }
    TestRun run(std::chrono::milliseconds time, std::chrono::seconds patience, uint32_t processes) {
        TestRun result;
        const Kit kit(folder(), {}, "");
        runTests(kit,
                 {.program = "fake", .filter = "*", .processes = processes, .until = Clock::now() + time, .patience = patience},
                 result);
        return result;
    }
    static TestEnd endOf(const TestRun& run, const std::string& name) {
        for (const device_check::TestOutcome& test : run.tests)
            if (test.name == name) return test.end;
        ADD_FAILURE() << "no test " << name;
        return TestEnd::NotRun;
    }
};

TEST_F(TestRuns, ATestThatCrashesOrHangsCostsOnlyItself) {
    for (const uint32_t processes : {1u, 3u}) {
        const TestRun result = run(std::chrono::seconds(30), std::chrono::seconds(1), processes);
        ASSERT_EQ(result.tests.size(), 5u) << result.problem;
        EXPECT_EQ(endOf(result, "Fake.Passes"), TestEnd::Passed);
        EXPECT_EQ(endOf(result, "Fake.Crashes"), TestEnd::Crashed);
        EXPECT_EQ(endOf(result, "Fake.Hangs"), TestEnd::Hung);
        EXPECT_EQ(endOf(result, "Fake.Fails"), TestEnd::Failed);
        EXPECT_EQ(endOf(result, "Given/Values.Pass/0"), TestEnd::Passed);
        EXPECT_FALSE(result.isGood());
    }
}

TEST_F(TestRuns, TestsThatThereWasNoTimeToListAreNoFailure) {
    const TestRun result = run(std::chrono::milliseconds(-1), std::chrono::seconds(1), 1);
    EXPECT_TRUE(result.tests.empty());
    EXPECT_TRUE(result.isGood()) << result.problem;
    EXPECT_FALSE(result.isComplete());
}

TEST_F(TestRuns, AFindingHasTheWordsOfTheTest) {
    const device_check::Json json = toJson(run(std::chrono::seconds(30), std::chrono::seconds(1), 1));
    ASSERT_EQ(json["findings"].size(), 3u) << json;
    EXPECT_EQ(json["findings"][2]["test"], "Fake.Fails");
    EXPECT_EQ(json["findings"][2]["text"], "the value is 3\n");
    EXPECT_NE(json["findings"][0]["text"].get<std::string>().find("signal"), std::string::npos) << json;
}

TEST_F(TestRuns, WhatTheTimeDoesNotAllowHasNotRunAndCanRunLater) {
    TestRun result = run(std::chrono::milliseconds(4000), std::chrono::seconds(0), 1);
    EXPECT_EQ(endOf(result, "Fake.Hangs"), TestEnd::NotRun);
    EXPECT_EQ(endOf(result, "Fake.Fails"), TestEnd::NotRun);
    EXPECT_EQ(endOf(result, "Fake.Passes"), TestEnd::Passed);
    const Kit kit(folder(), {}, "");
    runTests(kit,
             {.program = "fake",
              .filter = "*",
              .until = Clock::now() + std::chrono::seconds(30),
              .patience = std::chrono::seconds(1)},
             result);
    EXPECT_EQ(endOf(result, "Fake.Fails"), TestEnd::Failed);
    EXPECT_EQ(result.count(TestEnd::NotRun), 0u);
}

TEST_F(TestRuns, ATestThatHasTakenLongWhenTheTimeEndsHangs) {
    const TestRun result = run(std::chrono::milliseconds(5000), std::chrono::seconds(10), 1);
    EXPECT_EQ(endOf(result, "Fake.Hangs"), TestEnd::Hung);
    EXPECT_EQ(endOf(result, "Fake.Fails"), TestEnd::NotRun);
    EXPECT_FALSE(result.isGood());
}

TEST_F(TestRuns, AProgramThatDoesNotStartIsAProblemWithAReason) {
    TestRun result;
    const Kit kit(folder(), {}, "");
    runTests(kit, {.program = "missing", .filter = "*", .until = Clock::now() + std::chrono::seconds(5)}, result);
    EXPECT_FALSE(result.isGood());
    EXPECT_NE(result.problem.find("cannot be listed"), std::string::npos) << result.problem;
}

TEST(ChildProcess, IsEndedAtItsTimeLimitWithItsChildren) {
    const auto start = Clock::now();
    std::vector<std::string> lines;
    const ChildEnd end =
        device_check::runChild({{"/bin/sh", "-c", "echo begun; sleep 60 & wait"}, {}, start + std::chrono::seconds(3)},
                               [&](std::string_view line) { lines.emplace_back(line); });
    EXPECT_EQ(end.kind, ChildEnd::Kind::OutOfTime);
    EXPECT_EQ(lines, std::vector<std::string>{"begun"});
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(15));
}

class Followers : public support::FolderTest {
protected:
    // A process that runs a program, as `check` does. Returns once the program runs, with the ids of both.
    std::pair<pid_t, pid_t> start() const {
        const std::string file = path("id"), script = "echo $$ >" + file + ".new; mv " + file + ".new " + file + "; sleep 60";
        const pid_t parent = fork();
        if (parent == 0) {
            std::thread([] {
                std::this_thread::sleep_for(std::chrono::seconds(3));
                device_check::endChildren();
                _exit(0);
            }).detach();
            device_check::runChild({{"/bin/sh", "-c", script}, {}, Clock::now() + std::chrono::seconds(60)},
                                   [](std::string_view) {});
        }
        while (!std::filesystem::exists(file))
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        pid_t program = -1;
        std::ifstream(file) >> program;
        return {parent, program};
    }
    static bool endsSoon(pid_t pid) {
        for (int k = 0; k < 200 && kill(pid, 0) == 0; ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return kill(pid, 0) != 0;
    }
};

TEST_F(Followers, EndWithTheProcessThatRunsThem) {
    const auto [parent, program] = start();
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    EXPECT_TRUE(endsSoon(program));
}

TEST_F(Followers, EndWhenThatProcessIsInterrupted) {
    const auto [parent, program] = start();
    int status = -1;
    EXPECT_EQ(waitpid(parent, &status, 0), parent);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_TRUE(endsSoon(program));
}

TEST(ChildProcess, HasTheLastSettingOfAName) {
    const ChildEnd end = device_check::runChild(
        {{"/bin/sh", "-c", "echo $HOME"}, {"HOME=/one", "HOME=/two"}, Clock::now() + std::chrono::seconds(10)},
        [](std::string_view line) { EXPECT_EQ(line, "/two"); });
    EXPECT_TRUE(end.isGood()) << end.reason;
}

TEST(ChildProcess, TellsItsExitCodeAndTheLastLineOfItsErrors) {
    const ChildEnd end = device_check::runChild(
        {{"/bin/sh", "-c", "echo one >&2; echo two >&2; printf rest; exit 3"}, {}, Clock::now() + std::chrono::seconds(10)},
        [](std::string_view line) { EXPECT_EQ(line, "rest"); });
    EXPECT_EQ(end.kind, ChildEnd::Kind::Exited);
    EXPECT_EQ(end.code, 3);
    EXPECT_EQ(end.reason, "two");
}

} // namespace
} // namespace device_test
