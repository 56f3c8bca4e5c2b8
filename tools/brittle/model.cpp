#include "tools/brittle/model.h"

#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/primitives.h"
#include "tools/brittle/example_files.h"
#include "tools/brittle/progress.h"

#include <cstdio>

namespace cli {

engine::Result<brittle::ImportedMesh> importModel(const std::string& name) {
    constexpr std::string_view kBuiltin = "builtin:";
    if (name.starts_with(kBuiltin)) return brittle::makeBuiltin(name.substr(kBuiltin.size()));
    std::error_code unreadable;
    const std::filesystem::path example =
        std::filesystem::exists(name, unreadable) ? std::filesystem::path() : exampleFile(name);
    return brittle::importMesh(example.empty() ? std::filesystem::path(name) : example);
}

void reportReaderNotes(const std::string& name, const std::vector<std::string>& notes) {
    if (!notes.empty()) clearProgress();
    for (const std::string& note : notes)
        std::fprintf(stderr, "brittle: %s: note: %s\n", name.c_str(), note.c_str());
}

engine::Result<brittle::RepairedMesh> loadModel(const std::string& name, bool repair) {
    const auto imported = importModel(name);
    if (!imported) return imported.error();
    reportReaderNotes(name, imported->notes);
    const auto named = [&](const engine::Error& error) { return engine::Error{error.code, name + ": " + error.message}; };
    if (repair) {
        auto repaired = brittle::repairMesh(*imported);
        if (!repaired) return named(repaired.error());
        return repaired;
    }
    auto prepared = brittle::prepareMesh(*imported);
    if (!prepared) return named(prepared.error());
    return brittle::RepairedMesh{std::move(*prepared), {}};
}

std::string adviceToRepair(const brittle::MeshReport& report) {
    const uint32_t mendable = report.open_edges + report.inconsistent_edges + report.nonmanifold_edges +
                              report.duplicate_triangles + report.misplaced_components;
    return mendable > 0 ? "; or try --repair" : "";
}

void reportMended(const std::string& name, const brittle::RepairNotes& notes) {
    if (notes.isEmpty()) return;
    clearProgress();
    std::fprintf(stderr, "brittle: %s: mended: %s\n", name.c_str(), notes.text().c_str());
}

nlohmann::ordered_json mendedJson(const brittle::RepairNotes& notes) {
    nlohmann::ordered_json json;
    const auto add = [&](const char* name, const std::vector<brittle::Double3>& where) {
        json[name] = {{"count", where.size()}, {"where", where}};
    };
    add("joined_vertices", notes.joined_vertices);
    add("dropped_flat_triangles", notes.dropped_flat);
    add("split_edges", notes.split_edges);
    add("dropped_doubled_triangles", notes.dropped_doubles);
    add("turned_triangles", notes.turned_triangles);
    nlohmann::ordered_json holes = nlohmann::ordered_json::array();
    for (const brittle::RepairNotes::Hole& hole : notes.closed_holes)
        holes.push_back({{"edges", hole.edges}, {"diameter", hole.diameter}, {"where", hole.where}});
    json["closed_holes"] = {{"count", holes.size()}, {"holes", holes}};
    add("parts_turned_outward", notes.turned_parts);
    add("parts_turned_into_hollows", notes.turned_hollows);
    return json;
}

} // namespace cli
