#include "tools/brittle/doctor_report.h"

#include "modules/brittle/mesh/format.h"
#include "tools/brittle/model.h"

#include <cmath>
#include <cstdio>

namespace cli {
namespace {

using brittle::formatCount;
using brittle::formatNumber;
using brittle::formatPoint;
using brittle::MeshDiagnosis;

constexpr size_t kShown = 5; // of every kind, in text

void row(const char* label, const std::string& text) { std::printf("  %-12s %s\n", label, text.c_str()); }

// The first few of a list, each by its own line.
template <class List, class Describe>
void rows(const char* label, const List& list, const Describe& describe) {
    for (size_t k = 0; k < list.size() && k < kShown; ++k)
        row(k == 0 ? label : "", describe(list[k]));
    if (list.size() > kShown) row("", "and " + std::to_string(list.size() - kShown) + " more");
}

std::string firstPlaces(const std::vector<brittle::Double3>& places) {
    std::string text;
    for (size_t k = 0; k < places.size() && k < kShown; ++k)
        text += (k == 0 ? ", at " : ", ") + formatPoint(places[k]);
    return text + (places.size() > kShown ? ", ..." : "");
}

void printNotes(const brittle::PrepareNotes& notes) {
    std::string line;
    const auto add = [&](uint32_t count, const char* one, const char* many, const char* done) {
        if (count > 0) line += (line.empty() ? "" : ", ") + formatCount(count, one, many) + " " + done;
    };
    add(notes.unused, "unused vertex", "unused vertices", "left out");
    add(notes.welded, "vertex", "vertices", "joined to others at the same place");
    add(notes.collapsed, "collapsed triangle", "collapsed triangles", "dropped");
    if (notes.turned_inside_out) line += std::string(line.empty() ? "" : ", ") + "turned the right side out";
    if (!line.empty()) row("on reading", line);
}

std::string describePart(const MeshDiagnosis::Part& part) {
    std::string text = formatCount(part.triangles, "triangle") + ", ";
    if (part.is_one_sided)
        text += "one side only, ";
    else
        text += part.genus ? "genus " + std::to_string(*part.genus) + ", " : "branching, ";
    if (part.rims > 0)
        text += "open at " + formatCount(part.rims, "rim") + ", ";
    else
        text += (part.volume < 0 ? "around a hollow of " : "volume ") + formatNumber(std::abs(part.volume)) + ", ";
    return text + "area " + formatNumber(part.area) + ", at " + formatPoint(part.where);
}

std::string describeHole(const MeshDiagnosis::Hole& hole) {
    return formatCount(hole.edges, "edge") + ", " + formatNumber(hole.length) + " around, " + formatNumber(hole.diameter) +
           " across, at " + formatPoint(hole.where) + (hole.is_simple ? "" : ", not a simple loop");
}

void printSurface(const DoctorReport& report) {
    const brittle::MeshReport& found = report.diagnosis.report;
    row("surface", formatCount(found.vertices, "vertex", "vertices") + ", " + formatCount(found.triangles, "triangle") + ", " +
                       formatCount(report.diagnosis.parts.size(), "part") +
                       (found.cavities > 0 ? " (of them " + std::to_string(found.cavities) + " around hollows)" : ""));
    row("measures", "volume " + formatNumber(found.measures.volume) + ", area " + formatNumber(found.measures.area) +
                        ", diagonal " + formatNumber(found.measures.diagonal) + ", center " +
                        formatPoint(report.model->mesh.center));
    printNotes(report.model->notes);
    rows("parts", report.diagnosis.parts, describePart);
}

void printFaults(const MeshDiagnosis& found) {
    rows("holes", found.holes, describeHole);
    const auto places = [](const char* label, const std::string& text, const std::vector<brittle::Double3>& where) {
        if (!where.empty()) row(label, std::to_string(where.size()) + " " + text + firstPlaces(where));
    };
    places("edges", "of more than two triangles", found.nonmanifold_edges);
    places("edges", "where the surface turns over", found.inconsistent_edges);
    places("vertices", "where sheets touch that share no edge there", found.nonmanifold_vertices);
    places("triangles", "doubled", found.duplicates);
    places("folds", "edges at which a face lies on its neighbor", found.folds);
    rows("slivers", found.slivers, [](const MeshDiagnosis::Sliver& sliver) {
        const bool is_flat = !std::isfinite(sliver.aspect);
        return (is_flat ? "no area" : formatNumber(sliver.aspect) + " times as long as high") + ", at " +
               formatPoint(sliver.where);
    });
    rows("crossings", found.crossings, [](const MeshDiagnosis::Crossing& crossing) {
        return formatNumber(crossing.depth) + " deep, at " + formatPoint(crossing.where);
    });
    const brittle::SelfIntersection& crossings = found.report.self_intersection;
    if (crossings.touching_pairs > 0)
        row("touching", formatCount(crossings.touching_pairs, "pair") + " less than 1e-6 of the diagonal deep, which is fine");
}

nlohmann::ordered_json reportJson(const brittle::MeshReport& report) {
    return {
        {"sound", report.isSound()},
        {"problems", report.problems},
        {"vertices", report.vertices},
        {"triangles", report.triangles},
        {"components", report.components},
        {"cavities", report.cavities},
        {"volume", report.measures.volume},
        {"area", report.measures.area},
        {"diagonal", report.measures.diagonal},
        {"edges",
         {{"open", report.open_edges},
          {"inconsistent", report.inconsistent_edges},
          {"nonmanifold", report.nonmanifold_edges},
          {"shared", report.shared_edges}}},
        {"duplicate_triangles", report.duplicate_triangles},
        {"touching_triangles", report.touching_triangles},
        {"flat_triangles", report.flat_triangles},
        {"misplaced_components", report.misplaced_components},
        {"crossing_pairs", report.self_intersection.crossing_pairs},
        {"touching_pairs", report.self_intersection.touching_pairs},
        {"deepest_crossing", report.self_intersection.deepest.depth},
    };
}

// JSON has no infinity: null for a triangle without area.
void addPlaces(nlohmann::ordered_json& json, const MeshDiagnosis& found) {
    for (const MeshDiagnosis::Part& part : found.parts)
        json["parts"].push_back({{"where", part.where},
                                 {"triangles", part.triangles},
                                 {"vertices", part.vertices},
                                 {"edges", part.edges},
                                 {"rims", part.rims},
                                 {"one_sided", part.is_one_sided},
                                 {"genus", part.genus ? nlohmann::ordered_json(*part.genus) : nlohmann::ordered_json()},
                                 {"volume", part.volume},
                                 {"area", part.area}});
    for (const MeshDiagnosis::Hole& hole : found.holes)
        json["holes"].push_back({{"edges", hole.edges},
                                 {"length", hole.length},
                                 {"diameter", hole.diameter},
                                 {"where", hole.where},
                                 {"simple", hole.is_simple}});
    for (const MeshDiagnosis::Crossing& crossing : found.crossings)
        json["crossings"].push_back({{"depth", crossing.depth}, {"where", crossing.where}, {"triangles", crossing.triangles}});
    for (const MeshDiagnosis::Sliver& sliver : found.slivers)
        json["slivers"].push_back(
            {{"aspect", std::isfinite(sliver.aspect) ? nlohmann::ordered_json(sliver.aspect) : nlohmann::ordered_json()},
             {"where", sliver.where}});
    json["nonmanifold_edges_at"] = found.nonmanifold_edges;
    json["nonmanifold_vertices_at"] = found.nonmanifold_vertices;
    json["inconsistent_edges_at"] = found.inconsistent_edges;
    json["folds_at"] = found.folds;
    json["duplicate_triangles_at"] = found.duplicates;
}

} // namespace

void printReport(const DoctorReport& report) {
    const brittle::MeshReport& found = report.diagnosis.report;
    std::printf("%s: %s\n", report.name.c_str(), found.isSound() ? "sound, can be broken" : "cannot be broken");
    printSurface(report);
    for (const std::string& note : report.reader_notes)
        row("note", note);
    printFaults(report.diagnosis);
    if (report.mended && !report.mended->isEmpty()) row("mended", report.mended->text());
    for (const std::string& problem : found.problems)
        row("problem", problem);
}

void printReportJson(const DoctorReport& report) {
    nlohmann::ordered_json json = reportJson(report.diagnosis.report);
    json["center"] = report.model->mesh.center;
    const brittle::PrepareNotes& notes = report.model->notes;
    json["notes"] = {{"unused_vertices", notes.unused},
                     {"welded_vertices", notes.welded},
                     {"collapsed_triangles", notes.collapsed},
                     {"turned_inside_out", notes.turned_inside_out}};
    json["reader_notes"] = report.reader_notes;
    for (const char* list : {"parts", "holes", "crossings", "slivers"})
        json[list] = nlohmann::ordered_json::array();
    addPlaces(json, report.diagnosis);
    if (report.mended) json["mended"] = mendedJson(*report.mended);
    std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

} // namespace cli
