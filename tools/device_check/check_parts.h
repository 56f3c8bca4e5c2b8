// The parts of a check, in order. Each has a time limit of its own and gives one JSON object:
//     status   "passed", "failed", "stopped" (its time ran out and nothing had failed) or "skipped"
//     reason   one line, unless it passed
//     done, of how many of its tests, fractures, scenes or runs have ended, and how many there are
// and the findings.
#pragma once

#include "tools/device_check/results.h"
#include "tools/device_check/test_run.h"

#include <map>
#include <span>
#include <string>

namespace device_check {

// Test programs by the part and the program's name.
using TestRuns = std::map<std::string, TestRun>;

struct PartContext {
    const Kit& kit;
    const Json& expected; // of a known device; null if there is a problem
    const std::string& expected_problem;
    const Json& facts;            // of this device, once part "device" has run; else null
    std::filesystem::path folder; // for what a part must write; exists
    TestRuns& test_runs;          // the runs until now: a part that is called again goes on with the rest
    Clock::time_point until;
};

struct Part {
    const char* name;
    const char* title;
    double limit_s;
    Json (*run)(const PartContext& context);
    bool goes_on = false; // called again with the time that is left at the end
};

// Together they end within six minutes.
std::span<const Part> checkParts();

// Work of the parts, by file.
Json checkDevice(const PartContext& context);
Json checkKernels(const PartContext& context);
Json checkPrograms(const PartContext& context); // tests of the engine, the module and the C interface
Json checkModels(const PartContext& context);
Json checkScenes(const PartContext& context);
Json compareMotion(const PartContext& context);
Json checkValidation(const PartContext& context);
Json measureBench(const PartContext& context);
Json measureIdle(const PartContext& context);
Json measureStart(const PartContext& context);

} // namespace device_check
