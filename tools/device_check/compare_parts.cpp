// Parts whose outcome is held against that of a known device.
#include "tools/device_check/check_parts.h"

#include <algorithm>

namespace device_check {
namespace {

constexpr const char* kComparedSeconds = "0.5"; // as the recordings have (tools/gpu_check.sh)

// The lines that `brittle check-device --work` prints, as they come.
struct Work {
    Json lines = Json::array();
    ChildEnd end;
};

Work runWork(const PartContext& context, const std::string& what) {
    Work work;
    work.end = runChild(
        context.kit.command("brittle", {"check-device", "--work", what, "--kit", context.kit.path("").string()}, context.until),
        [&](std::string_view text) {
            Json line = Json::parse(text, nullptr, /*allow_exceptions=*/false);
            if (line.is_object()) work.lines.push_back(std::move(line));
        });
    return work;
}

// Returns the expected line about the same thing, or null.
Json expectedFor(const Json& expected, const char* list, const Json& line, std::initializer_list<const char*> keys) {
    if (!expected.is_object() || !expected.contains(list)) return nullptr;
    for (const Json& candidate : expected[list]) {
        bool same = true;
        for (const char* key : keys)
            same = same && candidate.value(key, Json()) == line.value(key, Json());
        if (same) return candidate;
    }
    return nullptr;
}

const char* comparison(const Json& line, const Json& expected, const char* key) {
    if (expected.is_null() || !expected.contains(key)) return "unknown";
    return line.value(key, Json()) == expected[key] ? "equal" : "differs";
}

// Failed if anything was found; else stopped or failed if the process did not end well.
Json outcomeOf(const Work& work, size_t findings, const std::string& what) {
    Json outcome;
    const bool out_of_time = work.end.kind == ChildEnd::Kind::OutOfTime;
    outcome["status"] = findings > 0 ? "failed" : work.end.isGood() ? "passed" : out_of_time ? "stopped" : "failed";
    if (findings > 0)
        outcome["reason"] = std::to_string(findings) + " " + what;
    else if (!work.end.isGood())
        outcome["reason"] = work.end.reason;
    return outcome;
}

// Models that the known device refuses are refused here with the same words.
bool modelFails(Json& line, const Json& known) {
    if (line.contains("error")) return known.is_null() || known.value("error", "") != line["error"];
    for (const char* key : {"topology", "positions", "attributes", "masses"})
        line[std::string(key) + "_is"] = comparison(line, known, key);
    return line["topology_is"] == "differs" || line["positions_is"] == "differs" || !line.value("violation", "").empty();
}

bool sceneFails(Json& line, const Json& known) {
    if (line.contains("error")) return known.is_null() || known.value("error", "") != line["error"];
    line["same_bits_twice"] = line["hashes"][0] == line["hashes"][1];
    line["hash_is"] = comparison(line, known, "hashes");
    line["fragments_is"] = comparison(line, known, "fragments");
    return !line["same_bits_twice"].get<bool>();
}

template <class Fails>
Json compare(const PartContext& context, const char* list, std::initializer_list<const char*> keys, const std::string& what,
             Fails&& fails) {
    Work work = runWork(context, list);
    size_t findings = 0;
    for (Json& line : work.lines)
        findings += fails(line, expectedFor(context.expected, list, line, keys)) ? 1 : 0;
    if (work.end.isGood() && work.lines.empty())
        return {{"status", "skipped"}, {"reason", std::string("the folder has no ") + list}};
    Json outcome = outcomeOf(work, findings, what);
    if (context.expected.is_null() && !outcome.contains("reason"))
        outcome["reason"] = "nothing was compared: the folder has no expected.json";
    outcome[list] = std::move(work.lines);
    return outcome;
}

} // namespace

Json checkDevice(const PartContext& context) {
    Work work = runWork(context, "facts");
    Json outcome = outcomeOf(work, 0, "");
    if (!work.lines.empty()) outcome["facts"] = work.lines[0];
    return outcome;
}

Json checkModels(const PartContext& context) {
    return compare(context, "models", {"model", "sites"}, "fractures differ from the expected ones", modelFails);
}

Json checkScenes(const PartContext& context) {
    return compare(context, "scenes", {"scene", "seconds"}, "scenes gave other bits the second time", sceneFails);
}

// Motion differs between devices by rounding; this tells where that begins. So a difference is no failure.
Json compareMotion(const PartContext& context) {
    Json outcome, scenes = Json::array();
    outcome["status"] = "passed";
    for (const std::filesystem::path& recording : context.kit.recordings()) {
        const std::string scene = recording.stem().string();
        std::string text;
        const ChildEnd end =
            runChild(context.kit.command("brittle",
                                         {"compare", "--device", context.facts.value("name", "0"), scene, "--seconds",
                                          kComparedSeconds, "--against", recording.string(), "--whole", "--json"},
                                         context.until),
                     [&](std::string_view line) { text += line; });
        const Json report = Json::parse(text, nullptr, /*allow_exceptions=*/false);
        if (end.isGood() && report.is_object()) {
            scenes.push_back(report);
            continue;
        }
        outcome["status"] = end.kind == ChildEnd::Kind::OutOfTime ? "stopped" : "failed";
        outcome["reason"] = scene + ": " + (end.reason.empty() ? "no report" : end.reason);
    }
    if (context.kit.recordings().empty()) return {{"status", "skipped"}, {"reason", "the folder has no recordings"}};
    outcome["scenes"] = std::move(scenes);
    return outcome;
}

Json measureIdle(const PartContext& context) {
    if (!std::filesystem::exists(context.kit.example("quiet_shelf")))
        return {{"status", "skipped"}, {"reason", "the folder has no example scenes"}};
    Work work = runWork(context, "idle");
    const auto failed = std::ranges::count_if(work.lines, [](const Json& line) { return line.contains("error"); });
    Json outcome = outcomeOf(work, static_cast<size_t>(failed), "scenes could not be stepped");
    outcome["steps"] = std::move(work.lines);
    return outcome;
}

} // namespace device_check
