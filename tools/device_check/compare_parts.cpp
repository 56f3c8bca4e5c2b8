// Parts whose outcome is held against that of a known device.
#include "tools/device_check/check_parts.h"

#include <algorithm>

namespace device_check {
namespace {

constexpr const char* kComparedSeconds = "0.5"; // as the recordings have (tools/gpu_check.sh)

// The lines that `brittle check-device --work` prints, as they come.
struct Work {
    Json lines = Json::array();
    size_t of = 0; // how many lines there are in all
    ChildEnd end;
};

Work runWork(const PartContext& context, const std::string& what) {
    Work work;
    work.end = runChild(
        context.kit.command("brittle", {"check-device", "--work", what, "--kit", context.kit.path("").string()}, context.until),
        [&](std::string_view text) {
            Json line = Json::parse(text, nullptr, /*allow_exceptions=*/false);
            if (line.is_object() && line.contains("of"))
                work.of = line["of"].get<size_t>();
            else if (line.is_object())
                work.lines.push_back(std::move(line));
        });
    work.of = std::max(work.of, work.lines.size());
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

std::string countOf(const Work& work, const std::string& things) {
    return std::to_string(work.lines.size()) + " of " + std::to_string(work.of) + " " + things;
}

// Failed if anything was found; else stopped if the time ran out, or failed if the process ended otherwise or too early.
Json outcomeOf(const Work& work, size_t findings, const std::string& what, const std::string& things) {
    const bool late = work.end.kind == ChildEnd::Kind::OutOfTime, whole = work.lines.size() == work.of;
    Json outcome = {{"status", findings > 0 ? "failed" : work.end.isGood() && whole ? "passed" : late ? "stopped" : "failed"}};
    std::string reason;
    if (findings > 0) reason = what;
    if (!whole) reason += (reason.empty() ? "" : "; ") + countOf(work, things) + " were done" + (late ? " in the time" : "");
    if (!work.end.isGood() && !late) reason += (reason.empty() ? "" : "; ") + work.end.reason;
    if (outcome["status"] == "stopped" && reason.empty()) reason = work.end.reason;
    if (!reason.empty()) outcome["reason"] = reason;
    outcome["done"] = work.lines.size();
    outcome["of"] = work.of;
    if (findings > 0) outcome["differing"] = findings;
    return outcome;
}

// Models that the known device refuses are refused here with the same words.
bool modelFails(Json& line, const Json& known) {
    if (line.contains("error")) return known.is_null() || Json(known.value("error", "")) != line["error"];
    for (const char* key : {"topology", "positions", "attributes", "masses"})
        line[std::string(key) + "_is"] = comparison(line, known, key);
    return line["topology_is"] != "equal" || line["positions_is"] != "equal" || !line.value("violation", "").empty();
}

bool sceneFails(Json& line, const Json& known) {
    if (line.contains("error")) return known.is_null() || Json(known.value("error", "")) != line["error"];
    line["same_bits_twice"] = line["hashes"][0] == line["hashes"][1];
    line["hash_is"] = comparison(line, known, "hashes");
    line["fragments_is"] = comparison(line, known, "fragments");
    return !line["same_bits_twice"].get<bool>();
}

struct Compared {
    const char* list;   // of the expected results, and the work
    const char* things; // for messages
    const char* differ; // what findings are
    const char* source; // the file or folder of the kit that they come from
    std::initializer_list<const char*> keys;
};

// Counts lines that differ and lines with an error, and describes them.
class Findings {
public:
    void add(const Json& line, const Compared& compared) {
        ++(line.contains("error") ? errors_ : differing_);
        if (errors_ == 1 && first_error_.empty())
            first_error_ = line.value(*compared.keys.begin(), "?") + ": " + line["error"].get<std::string>();
    }
    size_t count() const { return differing_ + errors_; }
    std::string text(const Compared& compared) const {
        std::string text;
        if (differing_ > 0) text = std::to_string(differing_) + " " + compared.differ;
        if (errors_ > 0)
            text += (text.empty() ? "" : "; ") + std::to_string(errors_) + " " + compared.things +
                    " ended with an error, first " + first_error_;
        return text;
    }

private:
    size_t differing_ = 0, errors_ = 0;
    std::string first_error_;
};

// Says which file of the kit is missing or damaged, if one is. A list that was cut short is no longer as long as expected.json.
std::string problemOfFolder(const PartContext& context, const Compared& compared, const Work& work) {
    if (!context.expected.is_object()) return "nothing was compared: " + context.expected_problem;
    if (work.of == 0 && work.end.isGood()) return std::string(compared.source) + " is missing";
    const size_t expected = context.expected[compared.list].size();
    if (work.of == 0 || work.of == expected) return "";
    return std::string(compared.source) + " gives " + std::to_string(work.of) + " " + compared.things + ", expected.json has " +
           std::to_string(expected) + "; copy the folder again";
}

// If the kit is damaged, the part fails and says so.
template <class Fails>
Json compare(const PartContext& context, const Compared& compared, Fails&& fails) {
    Work work = runWork(context, compared.list);
    Findings findings;
    if (context.expected.is_object())
        for (Json& line : work.lines)
            if (fails(line, expectedFor(context.expected, compared.list, line, compared.keys))) findings.add(line, compared);
    Json outcome = outcomeOf(work, findings.count(), findings.text(compared), compared.things);
    if (const std::string problem = problemOfFolder(context, compared, work); !problem.empty()) {
        outcome["status"] = "failed";
        outcome["reason"] = problem;
    }
    outcome[compared.list] = std::move(work.lines);
    return outcome;
}

// Names a recording that expected.json lists and the kit lacks.
std::string problemOf(const std::vector<std::filesystem::path>& recordings, const PartContext& context) {
    if (!context.expected.is_object()) return "nothing was compared: " + context.expected_problem;
    for (const Json& name : context.expected.value("recordings", Json::array()))
        if (std::ranges::none_of(recordings, [&](const auto& file) { return name == file.filename().string(); }))
            return "recordings/" + name.get<std::string>() + " is missing; copy the folder again";
    return "";
}

// Compares one scene's motion with a recording of it. Returns the report, or {"error", "out_of_time"}.
Json compareWith(const PartContext& context, const std::filesystem::path& recording) {
    std::string text;
    const ChildEnd end = runChild(
        context.kit.command("brittle",
                            {"compare", "--device", std::to_string(context.facts.value("index", 0)), recording.stem().string(),
                             "--seconds", kComparedSeconds, "--against", recording.string(), "--whole", "--json"},
                            context.until),
        [&](std::string_view line) { text += line; });
    Json report = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (end.isGood() && report.is_object()) return report;
    return {{"error", end.reason.empty() ? "no report" : end.reason}, {"out_of_time", end.kind == ChildEnd::Kind::OutOfTime}};
}

} // namespace

Json checkDevice(const PartContext& context) {
    Work work = runWork(context, "facts");
    Json outcome = outcomeOf(work, 0, "", "devices");
    outcome.erase("done");
    outcome.erase("of");
    if (!work.lines.empty()) outcome["facts"] = work.lines[0];
    return outcome;
}

Json checkModels(const PartContext& context) {
    return compare(context,
                   {"models", "fractures", "fractures differ from the expected ones", "meshes.txt", {"model", "sites"}},
                   modelFails);
}

Json checkScenes(const PartContext& context) {
    return compare(context,
                   {"scenes", "scenes", "scenes gave other bits the second time", "the list of scenes", {"scene", "seconds"}},
                   sceneFails);
}

// Motion differs between devices by rounding; this tells where that begins. So a difference is no failure.
Json compareMotion(const PartContext& context) {
    const std::vector<std::filesystem::path> recordings = context.kit.recordings();
    if (recordings.empty()) return {{"status", "failed"}, {"reason", "nothing was compared: recordings are missing"}};
    if (const std::string problem = problemOf(recordings, context); !problem.empty())
        return {{"status", "failed"}, {"reason", problem}};
    Json outcome = {{"status", "passed"}}, scenes = Json::array();
    for (const std::filesystem::path& recording : recordings) {
        Json report = compareWith(context, recording);
        if (!report.contains("error")) {
            scenes.push_back(std::move(report));
            continue;
        }
        const bool late = report["out_of_time"].get<bool>();
        if (outcome["status"] != "failed") outcome["status"] = late ? "stopped" : "failed";
        const std::string before = outcome.contains("reason") ? outcome["reason"].get<std::string>() + "; " : "";
        outcome["reason"] = before + recording.stem().string() + ": " + report["error"].get<std::string>();
    }
    outcome["done"] = scenes.size();
    outcome["of"] = recordings.size();
    outcome["scenes"] = std::move(scenes);
    return outcome;
}

Json measureIdle(const PartContext& context) {
    if (!std::filesystem::exists(context.kit.example("quiet_shelf")))
        return {{"status", "failed"}, {"reason", "the scene quiet_shelf is missing"}};
    Work work = runWork(context, "idle");
    const auto failed = std::ranges::count_if(work.lines, [](const Json& line) { return line.contains("error"); });
    Json outcome = outcomeOf(work, static_cast<size_t>(failed), "scenes could not be stepped", "measurements");
    outcome["steps"] = std::move(work.lines);
    return outcome;
}

} // namespace device_check
