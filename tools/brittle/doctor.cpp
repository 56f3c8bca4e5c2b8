// brittle doctor: whether a model can be broken, and what is wrong with it where it cannot.
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/format.h"
#include "tools/brittle/command.h"
#include "tools/brittle/model.h"
#include "tools/brittle/progress.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace cli {
namespace {

using brittle::formatCount;
using brittle::formatNumber;

void printNotes(const brittle::PrepareNotes& notes) {
    std::string line;
    const auto add = [&](uint32_t count, const char* one, const char* many, const char* done) {
        if (count > 0) line += (line.empty() ? "" : ", ") + formatCount(count, one, many) + " " + done;
    };
    add(notes.unused, "unused vertex", "unused vertices", "left out");
    add(notes.welded, "vertex", "vertices", "joined to others at the same place");
    add(notes.collapsed, "collapsed triangle", "collapsed triangles", "dropped");
    if (notes.turned_inside_out) line += std::string(line.empty() ? "" : ", ") + "turned the right side out";
    if (!line.empty()) std::printf("  on reading:  %s\n", line.c_str());
}

void printText(const std::string& name, const brittle::PreparedMesh& model, const brittle::MeshReport& report) {
    const brittle::SelfIntersection& found = report.self_intersection;
    std::printf("%s: %s\n", name.c_str(), report.isSound() ? "sound, can be broken" : "cannot be broken");
    std::printf("  surface:     %s, %s, %s", formatCount(report.vertices, "vertex", "vertices").c_str(),
                formatCount(report.triangles, "triangle").c_str(), formatCount(report.components, "part").c_str());
    std::printf(report.cavities > 0 ? " (of them %u around cavities)\n" : "\n", report.cavities);
    std::printf("  measures:    volume %s, area %s, diagonal %s, center %s\n", formatNumber(report.measures.volume).c_str(),
                formatNumber(report.measures.area).c_str(), formatNumber(report.measures.diagonal).c_str(),
                brittle::formatPoint(model.mesh.center).c_str());
    printNotes(model.notes);
    std::printf("  edges:       %u open, %u turned over, %u that do not pair up, %u where surfaces touch\n", report.open_edges,
                report.inconsistent_edges, report.nonmanifold_edges, report.shared_edges);
    std::printf("  triangles:   %u doubled, %u without area\n", report.duplicate_triangles, report.flat_triangles);
    std::printf(
        "  crossings:   %u pairs cross, %u only touch (less than 1e-6 of the diagonal deep); deepest %s of the diagonal\n",
        found.crossing_pairs, found.touching_pairs, formatNumber(found.deepest.depth / report.measures.diagonal).c_str());
    for (const std::string& problem : report.problems)
        std::printf("  problem:     %s\n", problem.c_str());
}

void printJson(const brittle::PreparedMesh& model, const brittle::MeshReport& report) {
    const brittle::SelfIntersection& found = report.self_intersection;
    const nlohmann::ordered_json json = {
        {"sound", report.isSound()},
        {"problems", report.problems},
        {"vertices", report.vertices},
        {"triangles", report.triangles},
        {"components", report.components},
        {"cavities", report.cavities},
        {"volume", report.measures.volume},
        {"area", report.measures.area},
        {"diagonal", report.measures.diagonal},
        {"center", model.mesh.center},
        {"notes",
         {{"unused_vertices", model.notes.unused},
          {"welded_vertices", model.notes.welded},
          {"collapsed_triangles", model.notes.collapsed},
          {"turned_inside_out", model.notes.turned_inside_out}}},
        {"edges",
         {{"open", report.open_edges},
          {"inconsistent", report.inconsistent_edges},
          {"nonmanifold", report.nonmanifold_edges},
          {"shared", report.shared_edges}}},
        {"duplicate_triangles", report.duplicate_triangles},
        {"flat_triangles", report.flat_triangles},
        {"misplaced_components", report.misplaced_components},
        {"crossing_pairs", found.crossing_pairs},
        {"touching_pairs", found.touching_pairs},
        {"deepest_crossing", found.deepest.depth},
    };
    std::printf("%s\n", json.dump(2).c_str());
}

int runDoctor(const std::string& name, bool as_json) {
    showProgress("reading " + name);
    const auto model = loadModel(name);
    if (!model) return fail(model.error());
    showProgress("examining " + name);
    const brittle::MeshReport report = brittle::inspectMesh(model->mesh, model->topology);
    clearProgress();
    if (as_json)
        printJson(*model, report);
    else
        printText(name, *model, report);
    if (report.isSound()) return kOk;
    return fail({engine::ErrorCode::BadInput, name + ": " + report.problems.front()});
}

} // namespace

void addDoctor(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("doctor", "Say whether a model can be broken, and what is wrong where it cannot.");
    command->footer("Example:\n  brittle doctor teapot.stl");
    auto name = std::make_shared<std::string>();
    auto as_json = std::make_shared<bool>(false);
    command->add_option("MODEL", *name, kModelHelp)->required();
    command->add_flag("--json", *as_json, "print JSON");
    command->callback([name, as_json, &exit_code] { exit_code = runDoctor(*name, *as_json); });
}

} // namespace cli
