// Parts that measure times.
#include "tools/brittle/command.h"
#include "tools/device_check/cached_start.h"
#include "tools/device_check/check_parts.h"

#include <algorithm>

namespace device_check {
namespace {

using std::chrono::duration;

struct BenchRun {
    const char* name;
    double limit_s;
    std::vector<std::string> arguments; // of brittle bench
};

// Each in a process of its own, so that one that is stopped costs only its own figures.
const std::vector<BenchRun>& benchRuns() {
    static const std::vector<BenchRun> runs = {
        {"cells", 10, {"--cells", "--cell-counts", "1000", "10000", "100000", "--kernels"}},
        {"shatter", 14, {"--shatter", "--shatter-counts", "10", "100", "1000", "--kernels"}},
        {"pile_100", 8, {"--piles", "--pile-counts", "100", "--pile-steps", "120"}},
        {"pile_1000", 8, {"--piles", "--pile-counts", "1000", "--pile-steps", "120"}},
        {"pile_5000", 12, {"--piles", "--pile-counts", "5000", "--pile-steps", "60"}},
        {"breaking", 14, {"--breaking", "--breaking-case", "10", "64", "0", "--plain"}},
        {"cells_1000000", 12, {"--cells", "--cell-counts", "1000000"}},
        {"pile_20000", 20, {"--piles", "--pile-counts", "20000", "--pile-steps", "30"}},
    };
    return runs;
}

Json runBench(const PartContext& context, const BenchRun& run) {
    const auto limit = std::chrono::duration_cast<Clock::duration>(duration<double>(run.limit_s));
    std::vector<std::string> arguments = {"bench", "--no-peers", "--rounds", "5"};
    arguments.insert(arguments.end(), run.arguments.begin(), run.arguments.end());
    std::string text;
    const ChildEnd end = runChild(context.kit.command("brittle", arguments, std::min(context.until, Clock::now() + limit)),
                                  [&](std::string_view line) { text += std::string(line) + "\n"; });
    Json report = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (end.isGood() && report.is_object()) return report;
    if (end.kind == ChildEnd::Kind::Exited && end.code == cli::kCapacity) return {{"too_large_for_device", end.reason}};
    return {{"error", end.reason.empty() ? "no report" : end.reason}, {"out_of_time", end.kind == ChildEnd::Kind::OutOfTime}};
}

Json startOf(const PartContext& context, const std::vector<std::string>& arguments, const std::filesystem::path& cache) {
    Json times = Json::object();
    std::filesystem::create_directories(cache);
    for (const char* which : {"cold", "warm"}) {
        const ChildEnd end = runWithCache(context.kit.command("brittle", arguments, context.until), cache);
        if (!end.isGood()) {
            times["error"] = end.reason;
            times["out_of_time"] = end.kind == ChildEnd::Kind::OutOfTime;
            return times;
        }
        times[std::string(which) + "_ms"] = 1000 * end.seconds;
    }
    return times;
}

// Failed if something gave an error; stopped if the time of all that gave none ran out. The reason names each.
void judge(Json& outcome, const Json& list, const std::string& things) {
    bool failed = false;
    size_t done = list.size();
    std::string names;
    for (const auto& [name, entry] : list.items()) {
        if (!entry.contains("error")) continue;
        --done;
        failed = failed || !entry.value("out_of_time", false);
        names += (names.empty() ? "" : "; ") + name + ": " + entry["error"].get<std::string>();
    }
    outcome["status"] = names.empty() ? "passed" : failed ? "failed" : "stopped";
    outcome["done"] = done;
    outcome["of"] = list.size();
    if (!names.empty())
        outcome["reason"] = std::to_string(done) + " of " + std::to_string(list.size()) + " " + things + " were done; " + names;
}

} // namespace

Json measureBench(const PartContext& context) {
    Json outcome, runs = Json::object();
    for (const BenchRun& run : benchRuns())
        runs[run.name] = Clock::now() < context.until
                             ? runBench(context, run)
                             : Json{{"error", "not begun: the part's time was over"}, {"out_of_time", true}};
    judge(outcome, runs, "runs");
    outcome["runs"] = std::move(runs);
    return outcome;
}

Json measureStart(const PartContext& context) {
    Json outcome, starts = Json::object();
    const std::filesystem::path scene = context.kit.example("window_pane");
    const std::string glb = (context.folder / "start.glb").string();
    starts["shatter"] =
        startOf(context, {"shatter", "builtin:icosphere:3", "--sites", "10", "-o", glb}, context.folder / "cache-shatter");
    if (std::filesystem::exists(scene))
        starts["window_pane"] =
            startOf(context, {"simulate", scene.string(), "--seconds", "0.1", "--state-hash"}, context.folder / "cache-scene");
    judge(outcome, starts, "starts");
    outcome["starts"] = std::move(starts);
    return outcome;
}

} // namespace device_check
