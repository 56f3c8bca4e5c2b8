#include "modules/brittle/mesh/repair/repair.h"

#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/repair/doubles.h"
#include "modules/brittle/mesh/repair/hole_filling.h"
#include "modules/brittle/mesh/repair/mesh_edit.h"
#include "modules/brittle/mesh/repair/orientation.h"
#include "modules/brittle/mesh/repair/seams.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

namespace brittle {
namespace {

engine::Error refuse(const std::string& message) { return {engine::ErrorCode::BadInput, "cannot be mended: " + message}; }

class Repair {
public:
    // `problem` is what is wrong with the mesh as it is.
    Repair(WeldedMesh welded, std::string problem)
        : welded_(std::move(welded)), mesh_(welded_.mesh), diagonal_(measureMesh(mesh_).diagonal),
          problem_(std::move(problem)) {}
    engine::Result<RepairedMesh> run();

private:
    engine::Result<void> mendSeams();
    engine::Result<void> makeNeighborsAgree();
    engine::Result<void> closeHoles();
    engine::Result<void> turnPartsOutward();
    void note(const std::vector<Double3>& where, std::vector<Double3>& notes) const {
        for (const Double3& place : where)
            notes.push_back(mesh_.center + place);
    }
    bool hasOddEdges() const;

    WeldedMesh welded_;
    Mesh& mesh_;
    double diagonal_;
    std::string problem_;
    RepairNotes notes_;
};

engine::Result<RepairedMesh> Repair::run() {
    if (auto mended = mendSeams(); !mended) return mended.error();
    note(dropDoubles(mesh_), notes_.dropped_doubles);
    if (mesh_.triangles.empty()) return refuse("nothing is left of it without doubled faces; give it a thickness");
    if (auto agree = makeNeighborsAgree(); !agree) return agree.error();
    if (auto closed = closeHoles(); !closed) return closed.error();
    if (!hasOddEdges())
        if (auto outward = turnPartsOutward(); !outward) return outward.error();
    RepairedMesh repaired{finishMesh(std::move(welded_)), std::move(notes_)};
    const auto report = checkMesh(repaired.model.mesh, repaired.model.topology);
    // Overlapping parts that were turned into hollows leave no volume; that is not what is wrong with the model.
    const bool is_nothing_left = std::abs(repaired.notes.volume_after) < 1e-6 * std::abs(repaired.notes.volume_before);
    if (!report) return refuse(is_nothing_left ? problem_ : report.error().message);
    return repaired;
}

// Seams move a surface by their own width, so they change the volume by no more than that times the area.
engine::Result<void> Repair::mendSeams() {
    const MeshMeasures before = measureMesh(mesh_);
    note(joinSeams(mesh_, diagonal_), notes_.joined_vertices);
    note(dropLooseFlat(mesh_), notes_.dropped_flat);
    note(splitJunctions(mesh_, diagonal_), notes_.split_edges);
    const double after = measureMesh(mesh_).volume;
    if (std::abs(after - before.volume) <= kSeamWidth * diagonal_ * before.area) return {};
    return refuse("joining its seams would change its volume from " + formatNumber(before.volume) + " to " +
                  formatNumber(after) + "; join them in a modeling program");
}

engine::Result<void> Repair::makeNeighborsAgree() {
    const MeshTopology topology = buildTopology(mesh_);
    const EdgeUses uses(topology);
    const Orientation found = findOrientation(mesh_, uses);
    if (!found.torn.empty()) {
        const auto& [a, b] = topology.edges[found.torn.front()];
        return refuse("the surface has one side only, like a Moebius strip, first seen at " +
                      formatPoint(mesh_.center + middleOfEdge(mesh_, a, b)) + "; cut it there and close both sides");
    }
    std::vector<Double3> turned;
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (!found.turn[t]) continue;
        turnTriangle(mesh_, t);
        turned.push_back(middleOf(cornersOf(mesh_, t)));
    }
    note(turned, notes_.turned_triangles);
    return {};
}

engine::Result<void> Repair::closeHoles() {
    const HoleFilling filling = fillHoles(mesh_, diagonal_);
    for (RepairNotes::Hole hole : filling.closed) {
        hole.where = mesh_.center + hole.where;
        notes_.closed_holes.push_back(hole);
    }
    if (filling.left.empty()) return {};
    const auto& [hole, why] = filling.left.front();
    return refuse(formatCount(filling.left.size(), "hole") + " left open; the first, of " + formatCount(hole.edges, "edge") +
                  ", " + formatNumber(hole.diameter) + " across around " + formatPoint(mesh_.center + hole.where) + ", " + why +
                  "; close it in a modeling program");
}

// Where an odd number of triangles meets there is no inside.
bool Repair::hasOddEdges() const {
    const MeshTopology topology = buildTopology(mesh_);
    const EdgeUses uses(topology);
    for (uint32_t edge = 0; edge < uses.edgeCount(); ++edge)
        if (uses.along(edge).size() % 2 != 0) return true;
    return false;
}

// The volume changes by that of the parts that are noted, and by nothing else.
engine::Result<void> Repair::turnPartsOutward() {
    notes_.volume_before = measureMesh(mesh_).volume;
    double expected = notes_.volume_before;
    for (const TurnedPart& part : turnOutward(mesh_)) {
        (part.is_hollow ? notes_.turned_hollows : notes_.turned_parts).push_back(mesh_.center + part.where);
        expected += part.added_volume;
    }
    const MeshMeasures after = measureMesh(mesh_);
    notes_.volume_after = after.volume;
    if (std::abs(after.volume - expected) <= 1e-9 * diagonal_ * after.area) return {};
    return refuse("turning its parts would change its volume to " + formatNumber(after.volume) + " instead of " +
                  formatNumber(expected) + "; please report it with this file");
}

void addText(std::string& line, size_t count, const Double3& first, const char* one, const char* many, const char* done) {
    line += (line.empty() ? "" : ", ") + formatCount(count, one, many) + " " + done + (count == 1 ? " at " : ", first at ") +
            formatPoint(first);
}

} // namespace

std::string RepairNotes::text() const {
    std::string line;
    const auto add = [&](const std::vector<Double3>& where, const char* one, const char* many, const char* done) {
        if (!where.empty()) addText(line, where.size(), where.front(), one, many, done);
    };
    add(joined_vertices, "vertex", "vertices", "joined to the one beside it");
    add(dropped_flat, "triangle without area", "triangles without area", "dropped");
    add(split_edges, "edge", "edges", "split where others end on it");
    add(dropped_doubles, "doubled triangle", "doubled triangles", "dropped");
    add(turned_triangles, "triangle", "triangles", "turned over");
    if (!closed_holes.empty()) addText(line, closed_holes.size(), closed_holes.front().where, "hole", "holes", "closed");
    add(turned_parts, "part", "parts", "turned outward");
    add(turned_hollows, "part inside another", "parts inside another", "turned into a hollow");
    if (!turned_parts.empty() || !turned_hollows.empty())
        line += "; the volume goes from " + formatNumber(volume_before) + " to " + formatNumber(volume_after);
    return line;
}

engine::Result<RepairedMesh> repairMesh(const ImportedMesh& imported) {
    auto welded = weldMesh(imported);
    if (!welded) return welded.error();
    PreparedMesh as_it_is = finishMesh(*welded);
    const MeshReport report = inspectMesh(as_it_is.mesh, as_it_is.topology);
    if (report.isSound()) return RepairedMesh{std::move(as_it_is), {}};
    return Repair(std::move(*welded), report.problems.front()).run();
}

} // namespace brittle
