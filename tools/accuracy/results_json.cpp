// Says in which member something was missing or of another type.
#define JSON_DIAGNOSTICS 1

#include "tools/accuracy/judge.h"
#include "tools/accuracy/results.h"
#include "tools/accuracy/results_check.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace accuracy {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Samples, raw, median, low, high)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Machine, processor, system, device, driver, compiler, brittle, commit, date, cores,
                                   memory_gib, load_before, seconds, processor_seconds, is_quick, rounds, scene_rounds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ErrorKind, name, label, unit, reference)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeasuredError, kind, value, resolution)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Workload, name, family, what, time_of, bytes_of, kinds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measurement, workload, knob, setting, loses, ms, bytes, errors, failed, times_default,
                                   is_default, is_dominated)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FigurePoint, sites, ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FigureSeries, label, points, ended)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Figure, name, title, caption, is_logarithmic, series)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CurvePoint, x, y)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CurveSeries, label, points)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Curve, name, title, caption, x_label, y_label, is_logarithmic_x, is_logarithmic_y, series)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StageTime, stage, ms)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Shares, sites, stages)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PicturePair, title, cheap_setting, dear_setting, caption, cheap_ms, dear_ms, differing_share,
                                   cheap, dear, marked)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LawBin, from, to, measured, law)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Law, title, quantity, law, source, count, distance, resolution, bins)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(HardCase, name, setting, why, worst_kind, unit, worst_error, allowed, has_passed,
                                   is_known_shortfall, ms, exact_tests)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Peer, name, workload, ms, errors)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UsefulLine, text, measurement)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PartTime, part, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Results, machine, parts, kinds, workloads, measurements, peers, figures, curves, shares,
                                   pictures, laws, useful, hard)

namespace {

using engine::Error;
using engine::ErrorCode;

Error refused(const std::filesystem::path& path, const std::string& why) {
    return {ErrorCode::BadInput, path.string() + ": " + why};
}

constexpr const char* kAdvice = "; measure anew with brittle accuracy -o DIR";

// What nlohmann::json says, without the number of its kind of exception.
std::string wordsOf(const std::exception& error) {
    const std::string text = error.what();
    const size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

engine::Result<std::string> readText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (file) text << file.rdbuf();
    if (!file || file.bad() || std::filesystem::is_directory(path)) return refused(path, "cannot be read");
    return text.str();
}

// What follows from the times that were taken, so that nobody has to keep to it who edits a file.
void conclude(Results& results) {
    for (Measurement& m : results.measurements)
        m.ms = samplesOf(std::move(m.ms.raw));
    for (Peer& peer : results.peers)
        peer.ms = samplesOf(std::move(peer.ms.raw));
    for (Figure& figure : results.figures)
        for (FigureSeries& series : figure.series)
            for (FigurePoint& point : series.points)
                point.ms = samplesOf(std::move(point.ms.raw));
    judge(results);
}

engine::Result<Results> decode(const std::filesystem::path& path, const nlohmann::json& json) {
    if (!json.is_object() || json.value("format", "") != kFormat)
        return refused(path, std::string("is no file of brittle accuracy (there is no \"format\": \"") + kFormat + "\")");
    if (json.value("version", 0) != kVersion)
        return refused(path, "is of version " + json.value("version", nlohmann::json()).dump() +
                                 ", this program reads version " + std::to_string(kVersion) + kAdvice);
    Results results = json.get<Results>();
    if (const std::string flaw = flawOf(results); !flaw.empty()) return refused(path, flaw + kAdvice);
    conclude(results);
    return results;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? "\"\"" : std::string(1, c);
    return out + "\"";
}

} // namespace

std::string encodeResults(const Results& results) {
    nlohmann::json json = results;
    json["format"] = kFormat;
    json["version"] = kVersion;
    return json.dump(1) + "\n";
}

std::string encodeCsv(const Results& results) {
    std::ostringstream csv;
    csv.precision(9);
    csv << "family,workload,knob,setting,is_default,is_dominated,ms,ms_low,ms_high,samples,times_default,bytes,error_kind,"
           "error,"
           "unit,resolution,failed,loses\n";
    for (const Measurement& m : results.measurements) {
        std::vector<MeasuredError> errors = m.errors;
        if (errors.empty()) errors.push_back({"", std::nan(""), std::nan("")});
        for (const MeasuredError& error : errors) {
            const ErrorKind* kind = kindOf(results, error.kind);
            csv << workloadOf(results, m.workload)->family << ',' << quoted(m.workload) << ',' << quoted(m.knob) << ','
                << quoted(m.setting) << ',' << m.is_default << ',' << m.is_dominated << ',' << m.ms.median << ',' << m.ms.low
                << ',' << m.ms.high << ',' << m.ms.raw.size() << ',' << m.times_default << ',' << m.bytes << ',';
            if (kind == nullptr)
                csv << ",,,";
            else
                csv << error.kind << ',' << error.value << ',' << quoted(kind->unit) << ',' << error.resolution;
            csv << ',' << quoted(m.failed) << ',' << quoted(m.loses) << '\n';
        }
    }
    return csv.str();
}

engine::Result<Results> readResults(const std::filesystem::path& path) {
    const auto text = readText(path);
    if (!text) return text.error();
    try {
        return decode(path, nlohmann::json::parse(*text));
    } catch (const nlohmann::json::parse_error& error) {
        return refused(path, "is no JSON: " + wordsOf(error) + kAdvice);
    } catch (const nlohmann::json::exception& error) {
        return refused(path, "is not whole: " + wordsOf(error) + kAdvice);
    }
}

} // namespace accuracy
