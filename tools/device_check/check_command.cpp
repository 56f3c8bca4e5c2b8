// brittle check-device: its options, and the parts of a check in order.
#include "engine/device.h"
#include "tools/accuracy/program_version.h"
#include "tools/brittle/command.h"
#include "tools/brittle/interrupt.h"
#include "tools/brittle/progress.h"
#include "tools/device_check/check_parts.h"
#include "tools/device_check/check_summary.h"
#include "tools/device_check/device_facts.h"
#include "tools/device_check/device_work.h"
#include "tools/device_check/output_folder.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace cli {
namespace {

using device_check::Clock;
using device_check::Json;
using device_check::Kit;
using device_check::Part;
using device_check::Results;

struct Options {
    std::string kit, output, device, work, expect;
    std::string loader, library_path; // how the machine that made the kit loads programs
    std::vector<std::string> parts;
    bool once = false;  // each scene
    double scale = 1;   // of all time limits
    double seconds = 1; // of each scene
    double spent = 0;   // s, of the time limit, before the check began
};

std::filesystem::path kitFolder(const Options& options) {
    if (!options.kit.empty()) return options.kit;
    return std::filesystem::path(device_check::ownPath()).parent_path().parent_path();
}

std::vector<std::string> launcherOf(const Options& options) {
    if (options.loader.empty()) return {};
    return {options.loader, "--library-path", options.library_path};
}

// Does the work of one part, in a process of its own.
int runWork(const Options& options) {
    auto device = engine::Device::create({.select = options.device, .share_pipelines = true});
    if (!device) return fail(device.error());
    const Kit kit(kitFolder(options), {}, options.device);
    if (options.work == "facts") std::printf("%s\n", device_check::textOf(device_check::factsOf(**device)).c_str());
    if (options.work == "models") device_check::fingerprintModels(**device, kit);
    if (options.work == "scenes") device_check::simulateScenes(**device, kit, options.seconds, options.once);
    if (options.work == "idle") device_check::measureIdleSteps(**device, kit);
    return kOk;
}

Clock::time_point inSeconds(double seconds) {
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// One line for each part. A reader that has gone away is no reason to stop: the files are what counts.
void tell(const Part& part, const Json& outcome) {
    static bool told = false;
    const std::string reason = outcome.value("reason", "");
    const int wrote = std::printf("%-42s %-8s %6.1f s%s\n", part.title, outcome["status"].get<std::string>().c_str(),
                                  outcome["seconds"].get<double>(), reason.empty() ? "" : ("  " + reason).c_str());
    if (wrote >= 0 && std::fflush(stdout) == 0) return;
    std::clearerr(stdout);
    if (std::freopen("/dev/null", "w", stdout) == nullptr) std::clearerr(stdout);
    if (!told) std::fprintf(stderr, "brittle: standard output cannot be written; the check goes on and writes its results\n");
    told = true;
}

bool isWanted(const Options& options, const Part& part) {
    return options.parts.empty() || std::ranges::find(options.parts, part.name) != options.parts.end();
}

Json aboutProgram() {
    const accuracy::ProgramVersion program = accuracy::programVersion();
    return {{"version", program.version}, {"commit", program.commit}, {"compiler", program.compiler}};
}

constexpr double kWholeCheck = 340, kWorthGoingOn = 10, kLongestWork = 3600; // s

// The parts of one check, in order.
class Check {
public:
    Check(const Options& options, std::filesystem::path scratch, std::filesystem::path cache)
        : options_(options), scratch_(std::move(scratch)),
          kit_(kitFolder(options), launcherOf(options), options.device, std::move(cache)),
          expected_(kit_.expected(expected_problem_)), until_(inSeconds((kWholeCheck - options.spent) * options.scale)) {}

    // The part about the device always runs: without a device nothing else can. Only then are files of an earlier check
    // replaced.
    int run(Results& results) {
        const auto parts = device_check::checkParts();
        const Json first = runPart(parts.front());
        if (!first.contains("facts"))
            return fail({engine::ErrorCode::Device, "no device to check: " + first.value("reason", "it said nothing")});
        if (auto kept = keepEarlier(results); !kept) return fail(kept.error());
        results.add(parts.front().name, first);
        for (const Part& part : parts.subspan(1))
            if (isWanted(options_, part)) results.add(part.name, runPart(part));
        for (const Part& part : parts)
            if (part.goes_on && isWanted(options_, part)) goOn(part, results);
        return hasFailed(results) ? kInternalError : kOk;
    }

private:
    static engine::Result<void> keepEarlier(Results& results) {
        const auto kept = results.keepEarlier();
        if (!kept) return kept.error();
        std::string names;
        for (const std::string& name : *kept)
            names += (names.empty() ? "" : " and ") + name;
        if (!names.empty()) std::printf("the results of an earlier check are now in %s\n", names.c_str());
        return {};
    }

    Json runPart(const Part& part) {
        showProgress(part.title);
        const auto start = Clock::now();
        const double scale = part.name == std::string_view("device") ? std::max(options_.scale, 1.0) : options_.scale;
        const auto until = std::min(inSeconds(part.limit_s * scale), until_);
        Json outcome = part.run({kit_, expected_, expected_problem_, facts_, scratch_, test_runs_, until});
        device_check::excuseFullDisk(outcome, scratch_);
        outcome["title"] = part.title;
        outcome["seconds"] = secondsSince(start);
        outcome["limit_s"] = part.limit_s * options_.scale;
        if (outcome.contains("facts")) facts_ = outcome["facts"];
        clearProgress();
        tell(part, outcome);
        return outcome;
    }

    // Gives the time that other parts have left to tests that did not run in their own.
    void goOn(const Part& part, Results& results) {
        const double left = std::chrono::duration<double>(until_ - Clock::now()).count();
        const Json before = results.json()["parts"].value(part.name, Json());
        if (left < kWorthGoingOn * options_.scale || before.is_null() || !hasTestsLeft(before)) return;
        Part more = part;
        more.limit_s = left / options_.scale;
        Json outcome = runPart(more);
        outcome["seconds"] = outcome["seconds"].get<double>() + before["seconds"].get<double>();
        outcome["limit_s"] = outcome["limit_s"].get<double>() + before["limit_s"].get<double>();
        results.add(part.name, outcome);
    }

    static bool hasTestsLeft(const Json& part) {
        if (!part.contains("programs")) return false;
        return std::ranges::any_of(part["programs"],
                                   [](const Json& run) { return run["not run"] != 0 || !run["listed"].get<bool>(); });
    }

    static bool hasFailed(Results& results) {
        return std::ranges::any_of(results.json()["parts"], [](const Json& part) { return part["status"] == "failed"; });
    }

    const Options& options_;
    std::filesystem::path scratch_;
    Kit kit_;
    std::string expected_problem_; // before expected_, which sets it
    Json expected_, facts_;
    Clock::time_point until_;
    device_check::TestRuns test_runs_;
};

constexpr uint64_t kRoomForCache = 256 << 20; // bytes

// The folder in which drivers keep compiled kernels, beside the results: a second check starts warm. None if the disk is nearly
// full. Mesa 22.3 confuses kernels of different subgroup sizes, so each size of lavapipe has a folder.
std::filesystem::path cacheIn(const std::filesystem::path& folder, Json& about) {
    const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    const std::filesystem::path cache = folder / (std::string("compiled") + (width != nullptr ? std::string("-") + width : ""));
    std::error_code failed;
    about = "none, because compiled beside the results is not a folder";
    if (std::filesystem::exists(cache, failed) && !std::filesystem::is_directory(cache, failed)) return {};
    about = "filled by an earlier check";
    if (std::filesystem::is_directory(cache, failed) && !std::filesystem::is_empty(cache, failed)) return cache;
    about = "none, there is too little room on the disk";
    if (device_check::freeBytes(folder) < kRoomForCache) return {};
    about = "empty at the beginning";
    std::filesystem::create_directories(cache, failed);
    return cache;
}

void sayEnd(Results& results, int code) {
    if (code == kDeviceError || code == kBadInput) return;
    results.json()["ended"] = true;
    results.write();
    std::printf("results in %s%s\n", (results.folder() / "results.html").c_str(),
                results.wasWritten() ? "" : ", as far as they could be written");
    const auto unchecked = results.json().value("unchecked", "");
    if (!unchecked.empty()) std::printf("%s\n", unchecked.c_str());
}

// Ends an interrupted check.
void leave(const std::filesystem::path& scratch, const std::filesystem::path& folder) {
    device_check::endChildren();
    std::error_code ignored;
    std::filesystem::remove_all(scratch, ignored);
    clearProgress();
    std::fprintf(stderr, "brittle: interrupted; the results of the parts that have ended are in %s\n",
                 (folder / "results.html").c_str());
}

int runCheck(const Options& options) {
    std::signal(SIGPIPE, SIG_IGN);
    const std::filesystem::path folder = options.output.empty() ? kitFolder(options) : std::filesystem::path(options.output);
    const auto lock = device_check::lockFolder(folder); // until the end
    if (!lock) return fail(lock.error());
    const auto scratch = device_check::makeScratch(folder);
    if (!scratch) return fail(scratch.error());
    whenInterrupted([path = *scratch, folder] { leave(path, folder); });
    Results results(folder, {{kitFolder(options).string(), "KIT"}, {scratch->string(), "SCRATCH"}});
    results.json() = {{"format", 1}, {"brittle", aboutProgram()}, {"ended", false}};
    const std::filesystem::path cache = cacheIn(folder, results.json()["compiled_kernels"]);
    results.json()["parts"] = Json::object();
    const int code = Check(options, *scratch, cache).run(results);
    sayEnd(results, code);
    std::error_code ignored;
    std::filesystem::remove_all(*scratch, ignored);
    return code == kOk && !results.wasWritten() ? int{kBadInput} : code;
}

// Returns the lines that one kind of work prints, and shows progress.
engine::Result<Json> linesOf(const Options& options, const std::string& work) {
    const Kit kit(kitFolder(options), launcherOf(options), options.device);
    Json lines = Json::array();
    const auto add = [&](std::string_view text) {
        if (Json line = Json::parse(text, nullptr, /*allow_exceptions=*/false); line.is_object())
            if (!line.contains("of")) lines.push_back(std::move(line));
        showProgress("expected " + work + ": " + std::to_string(lines.size()));
    };
    const auto end =
        runChild(kit.command("brittle", {"check-device", "--work", work, "--once", "--kit", kitFolder(options).string()},
                             inSeconds(kLongestWork)),
                 add);
    clearProgress();
    if (!end.isGood()) return engine::Error{engine::ErrorCode::Internal, work + ": " + end.reason};
    return lines;
}

// Writes the file that other devices are compared with.
int writeExpected(const Options& options) {
    Json expected;
    for (const char* work : {"facts", "models", "scenes"}) {
        auto lines = linesOf(options, work);
        if (!lines) return fail(lines.error());
        expected[work] = std::move(*lines);
    }
    expected["recordings"] = Json::array();
    for (const std::filesystem::path& recording : Kit(kitFolder(options), {}, options.device).recordings())
        expected["recordings"].push_back(recording.filename().string());
    auto file = createOutput(options.expect);
    if (!file) return fail(file.error());
    if (auto written = file->write(device_check::textOf(expected, 1) + "\n"); !written) return fail(written.error());
    if (auto committed = file->commit(); !committed) return fail(committed.error());
    return kOk;
}

std::vector<std::string> partNames() {
    std::vector<std::string> names;
    for (const Part& part : device_check::checkParts())
        names.emplace_back(part.name);
    return names;
}

constexpr const char* kCheckFooter =
    "Examples:\n"
    "  brittle check-device -o out/check\n"
    "  brittle check-device --parts models scenes -o out/check\n"
    "\n"
    "Writes results.json and results.html after each part. tools/gpu_check.sh packs a folder with all that a check needs;\n"
    "there, run.sh calls this. Exit codes: 0 nothing failed, 1 something did, 4 no device.";

} // namespace

void addCheckDevice(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("check-device", "Check a device: facts, tests, fragments, scenes, times; at most six minutes.");
    command->footer(kCheckFooter);
    auto options = std::make_shared<Options>();
    command->add_option("-o,--output", options->output, "the folder for the results; else the kit's")
        ->take_last()
        ->check(someText);
    command->add_option("--kit", options->kit, "the folder with programs, meshes, scenes; else the one above this program's")
        ->check(someText);
    command->add_option("--device", options->device,
                        "a part of the name, or the index; else $BRITTLE_DEVICE, else the fastest");
    command->add_option("--parts", options->parts, "only these parts, and the facts of the device")
        ->check(CLI::IsMember(partNames()));
    inRange(command->add_option("--limit-scale", options->scale, "multiplies the time limits of all parts"), 0.01, 100)
        ->capture_default_str();
    command->add_option("--loader", options->loader, "the dynamic loader to run all programs by")->check(someText);
    command->add_option("--library-path", options->library_path, "where that loader looks for libraries")->check(someText);
    command
        ->add_option("--write-expected", options->expect,
                     "write what this device gives to this file, for others to be held against")
        ->check(someText);
    command->add_option("--spent", options->spent)->group("");
    command->add_flag("--once", options->once)->group("");
    command->add_option("--work", options->work)->group("")->check(CLI::IsMember({"facts", "models", "scenes", "idle"}));
    command->callback([options, &exit_code] {
        exit_code = !options->work.empty()     ? runWork(*options)
                    : !options->expect.empty() ? writeExpected(*options)
                                               : runCheck(*options);
    });
}

} // namespace cli
