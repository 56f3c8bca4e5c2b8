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

// The worst of the two.
void merge(Json& outcome, const TestRun& run) {
    const std::string status = !run.isGood() ? "failed" : run.isComplete() ? "passed" : "stopped";
    if (!outcome.contains("status") || status == "failed" || (status == "stopped" && outcome["status"] == "passed"))
        outcome["status"] = status;
}

void addText(Json& outcome, const std::string& text) {
    outcome["reason"] = outcome.contains("reason") ? outcome["reason"].get<std::string>() + "; " + text : text;
}

// Names what failed, what did not run and what was not even listed. Tests that are not listed are not in `of`.
void addReason(Json& outcome) {
    size_t failed = 0, left = 0, of = 0;
    std::string unlisted;
    for (const auto& [name, run] : outcome["programs"].items()) {
        failed += run["findings"].size();
        left += run["not run"].get<size_t>();
        of += run["tests"].get<size_t>();
        if (!run["listed"].get<bool>() && !run.contains("problem")) unlisted += (unlisted.empty() ? "" : ", ") + name;
    }
    outcome["done"] = of - left;
    outcome["of"] = of;
    if (failed > 0) addText(outcome, std::to_string(failed) + " tests failed");
    for (const auto& [name, run] : outcome["programs"].items())
        if (run.contains("problem")) addText(outcome, run["problem"].get<std::string>());
    if (left > 0) addText(outcome, std::to_string(of - left) + " of " + std::to_string(of) + " tests were run in the time");
    if (!unlisted.empty()) addText(outcome, "there was no time to list the tests of " + unlisted);
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
    return runPrograms(context, "programs",
                       {{"engine", "brittle_tests_engine", "*"},
                        {"abi", "brittle_tests_abi", "-Long*"},
                        {"module", "brittle_tests_module", kOfDevices}});
}

Json checkValidation(const PartContext& context) {
    const std::filesystem::path layer = context.kit.path("layer");
    if (!std::filesystem::exists(layer)) return {{"status", "skipped"}, {"reason", "the folder has no validation layer"}};
    // Loaders go on without a layer that they do not find. The tests of missing barriers notice that.
    Json outcome =
        runPrograms(context, "validation",
                    {{"engine", "brittle_tests_engine", "Barriers.AreMiss*"}, {"kernel", "brittle_tests_kernel", "Small*"}},
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
