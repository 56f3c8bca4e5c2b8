// Runs a GoogleTest program in several processes at a time, within a time limit. A test that crashes or hangs costs only
// itself: the tests behind it run in a fresh process.
#pragma once

#include "tools/device_check/kit.h"

#include <string>
#include <vector>

namespace device_check {

enum class TestEnd { Passed, Skipped, Failed, Crashed, Hung, NotRun };

struct TestOutcome {
    std::string name; // "Suite.Test"
    TestEnd end = TestEnd::NotRun;
    double ms = 0;
    std::string text; // of what did not pass: the first lines that it printed, or why its process ended
};

struct TestRunOptions {
    std::string program; // in the kit's bin/
    std::string filter;  // as of --gtest_filter
    uint32_t processes = 1;
    Clock::time_point until;
    std::chrono::seconds patience{0}; // for one test; 0: until the limit
    std::vector<std::string> environment;
};

struct TestRun {
    std::vector<TestOutcome> tests; // in the program's order; none if there was no time to list them
    std::string problem;            // if the tests cannot be listed, or a process ended badly behind its last test

    bool isComplete() const; // the tests are listed and all of them have ended
    size_t count(TestEnd end) const;
    bool isGood() const;    // nothing failed, crashed or hung; tests that did not run in time are no failure
    bool isSkipped() const; // complete, and every test has skipped itself
};

// Runs those tests of `run` that have not run yet; all tests of the program if `run` has none. So a run that was cut short can
// go on later.
void runTests(const Kit& kit, const TestRunOptions& options, TestRun& run);

Json toJson(const TestRun& run);

} // namespace device_check
