// Parts that run the project's own tests.
#include "tools/device_check/check_parts.h"

#include <algorithm>
#include <thread>

namespace device_check {
namespace {

constexpr uint32_t kMostProcesses = 16;
constexpr uint64_t kBytesForProcess = uint64_t{2} << 30; // of the device's own memory: a context and the tests' worlds
constexpr std::chrono::seconds kPatience{90};            // for one test on a GPU

bool isCpu(const PartContext& context) { return context.facts.is_object() && context.facts.value("is_cpu", false); }

uint64_t localBytes(const PartContext& context) {
    uint64_t most = 0;
    if (!context.facts.is_object()) return most;
    for (const Json& heap : context.facts["memory"]["heaps"])
        if (heap["device_local"].get<bool>()) most = std::max(most, heap["bytes"].get<uint64_t>());
    return most;
}

// A GPU's time goes into compiling kernels, on the host's cores. A CPU device has threads of its own.
uint32_t processesFor(const PartContext& context) {
    const uint32_t cores = std::max(1u, std::thread::hardware_concurrency());
    if (isCpu(context)) return std::max(1u, cores / 2);
    const uint64_t fitting = std::max<uint64_t>(1, localBytes(context) / kBytesForProcess);
    return static_cast<uint32_t>(std::min<uint64_t>({cores, kMostProcesses, fitting}));
}

TestRunOptions optionsFor(const PartContext& context, const std::string& program, const std::string& filter) {
    TestRunOptions options{.program = program, .filter = filter, .processes = processesFor(context), .until = context.until};
    if (!isCpu(context)) options.patience = kPatience;
    options.environment = {"TMPDIR=" + context.folder.string()};
    return options;
}

constexpr std::string_view kWorstLast[] = {"passed", "skipped", "stopped", "failed"};

std::string_view statusOf(const TestRun& run) {
    if (!run.isGood()) return "failed";
    if (!run.isComplete()) return "stopped";
    return run.isSkipped() ? "skipped" : "passed";
}

// The worst of the two.
void merge(Json& outcome, const TestRun& run) {
    const auto rank = [](std::string_view status) { return std::ranges::find(kWorstLast, status) - kWorstLast; };
    const std::string_view status = statusOf(run);
    if (!outcome.contains("status") || rank(status) > rank(outcome["status"].get<std::string>())) outcome["status"] = status;
}

size_t sumOf(const Json& programs, const char* key) {
    size_t sum = 0;
    for (const Json& run : programs)
        sum += run[key].get<size_t>();
    return sum;
}

// The programs whose tests are not known, because there was no time to list them.
std::string unlistedIn(const Json& programs) {
    std::string names;
    for (const auto& [name, run] : programs.items())
        if (!run["listed"].get<bool>() && !run.contains("problem")) names += (names.empty() ? "" : ", ") + name;
    return names;
}

// Tests that are not listed are not in `of`. Tests that skipped themselves are not in `done`.
void count(Json& outcome) {
    const Json programs = outcome["programs"]; // a copy: what is added to `outcome` moves its members
    const size_t of = sumOf(programs, "tests"), skipped = sumOf(programs, "skipped");
    outcome["done"] = of - sumOf(programs, "not run") - skipped;
    outcome["of"] = of;
    outcome["skipped"] = skipped;
    outcome["unlisted"] = std::ranges::count_if(programs, [](const Json& run) { return !run["listed"].get<bool>(); });
}

// Names what failed, what did not run and what was not even listed.
void addReason(Json& outcome) {
    const Json& programs = outcome["programs"];
    const size_t failed = sumOf(programs, "failed") + sumOf(programs, "crashed") + sumOf(programs, "hung");
    const size_t left = sumOf(programs, "not run"), of = sumOf(programs, "tests"), skipped = sumOf(programs, "skipped");
    std::string reason;
    const auto add = [&](const std::string& text) { reason += (reason.empty() ? "" : "; ") + text; };
    if (failed > 0) add(std::to_string(failed) + " tests failed");
    for (const Json& run : programs)
        if (run.contains("problem")) add(run["problem"].get<std::string>());
    if (left > 0) add(std::to_string(of - left) + " of " + std::to_string(of) + " tests were run in the time");
    if (skipped > 0) add(std::to_string(skipped) + " tests skipped themselves: the device or the folder lacks what they need");
    if (const std::string names = unlistedIn(programs); !names.empty()) add("there was no time to list the tests of " + names);
    if (!reason.empty()) outcome["reason"] = reason;
}

struct Program {
    const char* name;
    const char* file;
    const char* filter;
};

Json runPrograms(const PartContext& context, const std::string& part, std::initializer_list<Program> programs,
                 const std::vector<std::string>& environment = {}) {
    Json outcome;
    outcome["programs"] = Json::object();
    for (const Program& program : programs) {
        TestRunOptions options = optionsFor(context, program.file, program.filter);
        options.environment.insert(options.environment.end(), environment.begin(), environment.end());
        TestRun& run = context.test_runs[part + "/" + program.name];
        runTests(context.kit, options, run);
        outcome["programs"][program.name] = toJson(run);
        merge(outcome, run);
    }
    count(outcome);
    addReason(outcome);
    return outcome;
}

} // namespace

Json checkKernels(const PartContext& context) {
    return runPrograms(context, "kernels", {{"kernel", "brittle_tests_kernel", "-Long*"}});
}

// Left out are tests of files and descriptions, and of models that lie elsewhere: they say nothing about a device.
Json checkPrograms(const PartContext& context) {
    constexpr const char* kOfDevices =
        "-Long*:Hostile*:OddPaths*:*EveryMesh*:Diagnosis*:QuickModels*:SmallSceneHull*:SceneFile*:Import*:Repair*";
    constexpr const char* kWithoutLayer = "-Barriers.AreMiss*:Devices.CountWhat*:Devices.HearOf*"; // of the validation layer
    return runPrograms(context, "programs",
                       {{"engine", "brittle_tests_engine", kWithoutLayer},
                        {"abi", "brittle_tests_abi", "-Long*"},
                        {"module", "brittle_tests_module", kOfDevices}});
}

Json checkValidation(const PartContext& context) {
    const std::filesystem::path layer = context.kit.path("layer");
    if (!std::filesystem::exists(layer)) return {{"status", "skipped"}, {"reason", "the folder has no validation layer"}};
    // Loaders go on without a layer that they do not find. The tests of missing barriers notice that.
    Json outcome = runPrograms(context, "validation",
                               {{"engine", "brittle_tests_engine", "Barriers.AreMiss*:Devices.CountWhat*"},
                                {"kernel", "brittle_tests_kernel", "Small*"}},
                               {"VK_LAYER_PATH=" + layer.string(), "VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation",
                                "VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT:"
                                "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT"});
    const Json& barriers = outcome["programs"]["engine"];
    if (barriers["skipped"] == 0 && barriers["failed"] == 0) return outcome;
    outcome["status"] = "failed";
    outcome["reason"] = "the validation layer was not loaded, or it noticed no missing barrier; so nothing was validated";
    return outcome;
}

} // namespace device_check
