#include "modules/brittle/mesh/check.h"

#include "modules/brittle/mesh/components.h"
#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/nesting.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

// A plate as thin as this share of its size has no inside on a grid of 24 bits.
constexpr double kMinThickness = 3e-8;

// Pairs of triangles with the same three corners, each with the next such triangle.
std::vector<std::array<uint32_t, 2>> findCoincident(const Mesh& mesh) {
    std::vector<std::pair<Index3, uint32_t>> sorted;
    sorted.reserve(mesh.triangles.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Index3 corners = mesh.triangles[t];
        std::sort(corners.begin(), corners.end());
        sorted.emplace_back(corners, t);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::array<uint32_t, 2>> pairs;
    for (size_t k = 1; k < sorted.size(); ++k)
        if (sorted[k].first == sorted[k - 1].first) pairs.push_back({sorted[k - 1].second, sorted[k].second});
    return pairs;
}

// Returns whether two triangles with the same corners run opposite ways.
bool facesBack(const Index3& a, const Index3& b) {
    const size_t k = static_cast<size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
    return b[(k + 1) % 3] == a[2];
}

double largestVolume(const Components& components) {
    double largest = 0;
    for (const Component& component : components.all)
        largest = std::max(largest, component.volume);
    return largest;
}

// Returns whether two components may share a wall: two solids, or a solid that fills a hollow. A hollow needs a solid larger
// than itself around it; without one, the two components are the sides of one doubled surface.
bool areNeighbors(const Components& components, uint32_t a, uint32_t b, double largest) {
    constexpr double kRounding = 1e-9; // of volumes
    const auto [less, more] = std::minmax(components.all[a].volume, components.all[b].volume);
    if (a == b || !(more > 0)) return false;
    return less > 0 || largest * (1 - kRounding) > -less;
}

class Inspector {
public:
    Inspector(const Mesh& mesh, const MeshTopology& topology) : mesh_(mesh), topology_(topology) {}
    MeshReport run();

private:
    void countEdges();
    void countTriangles(const Components& components);
    void checkVolume();
    void checkCrossings(const TriangleTree& tree);
    void checkNesting(const TriangleTree& tree, const Components& components);
    void complain(uint64_t count, const std::string& what, const Double3& where, const std::string& advice);
    Double3 midpoint(uint32_t edge) const;
    Double3 midpointOf(uint32_t triangle) const;

    const Mesh& mesh_;
    const MeshTopology& topology_;
    MeshReport report_;
};

MeshReport Inspector::run() {
    report_.vertices = static_cast<uint32_t>(mesh_.positions.size());
    report_.triangles = static_cast<uint32_t>(mesh_.triangles.size());
    if (mesh_.triangles.empty()) {
        report_.problems.emplace_back("no triangles");
        return report_;
    }
    report_.measures = measureMesh(mesh_);
    const Components components = findComponents(mesh_, topology_);
    countEdges();
    countTriangles(components);
    const bool has_surface = report_.isSound();
    const TriangleTree tree(mesh_);
    checkCrossings(tree);
    report_.components = static_cast<uint32_t>(components.all.size());
    for (const Component& component : components.all)
        report_.cavities += component.volume < 0 ? 1 : 0;
    if (!has_surface) return report_; // what is not closed has no volume
    checkVolume();
    checkNesting(tree, components);
    return report_;
}

void Inspector::complain(uint64_t count, const std::string& what, const Double3& where, const std::string& advice) {
    if (count == 0) return;
    report_.problems.push_back(formatCount(count, what) + ", first at " + formatPoint(mesh_.center + where) + "; " + advice);
}

Double3 Inspector::midpoint(uint32_t edge) const {
    const auto& [a, b] = topology_.edges[edge];
    return middleOfEdge(mesh_, a, b);
}

Double3 Inspector::midpointOf(uint32_t triangle) const { return middleOf(cornersOf(mesh_, triangle)); }

// An edge is sound when as many triangles run along it one way as the other.
void Inspector::countEdges() {
    struct Uses {
        uint32_t up = 0, down = 0;
    };
    std::vector<Uses> uses(topology_.edges.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const bool runs_up = mesh_.triangles[t][k] < mesh_.triangles[t][(k + 1) % 3];
            ++(runs_up ? uses[topology_.triangle_edges[t][k]].up : uses[topology_.triangle_edges[t][k]].down);
        }
    std::array<Double3, 3> first = {};
    const auto note = [&](uint32_t& count, size_t kind, size_t edge) {
        if (count++ == 0) first[kind] = midpoint(static_cast<uint32_t>(edge));
    };
    for (size_t e = 0; e < uses.size(); ++e) {
        const uint32_t total = uses[e].up + uses[e].down;
        if (uses[e].up == uses[e].down)
            report_.shared_edges += total > 2 ? 1 : 0;
        else if (total == 1)
            note(report_.open_edges, 0, e);
        else if (total == 2)
            note(report_.inconsistent_edges, 1, e);
        else
            note(report_.nonmanifold_edges, 2, e);
    }
    complain(report_.open_edges, "open edge", first[0], "close the holes of the surface");
    complain(report_.inconsistent_edges, "edge", first[1], "where the surface turns over; make its faces point outward");
    complain(report_.nonmanifold_edges, "edge", first[2], "where triangles do not pair up; remove inner or doubled faces");
}

void Inspector::countTriangles(const Components& components) {
    for (size_t t = 0; t < mesh_.triangles.size(); ++t)
        report_.flat_triangles += isFlat(cornersOf(mesh_, t)) ? 1 : 0;
    const auto [faulty, walls] = findDuplicates(mesh_, components);
    report_.duplicate_triangles = static_cast<uint32_t>(faulty.size());
    report_.touching_triangles = walls;
    if (faulty.empty()) return;
    complain(report_.duplicate_triangles, "doubled triangle", middleOf(cornersOf(mesh_, faulty.front())),
             "remove doubled faces, or give the sheet a thickness");
}

void Inspector::checkVolume() {
    const MeshMeasures& m = report_.measures;
    if (m.volume > kMinThickness * m.area * m.diagonal) return;
    report_.problems.push_back("a volume of " + formatNumber(m.volume) + ": the model is flat; give it a thickness");
}

void Inspector::checkCrossings(const TriangleTree& tree) {
    report_.self_intersection = findSelfIntersections(mesh_, tree, report_.measures.diagonal);
    const SelfIntersection& found = report_.self_intersection;
    if (found.gave_up)
        report_.problems.push_back(
            "more than " + std::to_string(kMaxPairTests) +
            " pairs of triangles so close that their boxes touch, too many to look through; simplify it");
    if (found.crossing_pairs == 0) return;
    const std::string more = found.crossing_pairs >= kMaxCrossings ? "more than " : "";
    report_.problems.push_back(more + formatCount(found.crossing_pairs, "pair") + " of triangles that cross, " +
                               formatNumber(found.deepest.depth) + " deep at " +
                               formatPoint(mesh_.center + found.deepest.where) +
                               "; unite the overlapping parts (boolean union) or move them apart");
}

void Inspector::checkNesting(const TriangleTree& tree, const Components& components) {
    Double3 first = {0, 0, 0};
    Nesting nesting(mesh_, tree, components, report_.measures.diagonal);
    for (uint32_t c = 0; c < components.all.size(); ++c) {
        if (nesting.isTooLong()) {
            report_.problems.emplace_back("too many parts behind one another to see which lie inside which; unite them");
            return;
        }
        if (nesting.windingBelow(c) == 1) continue;
        if (report_.misplaced_components++ == 0) first = midpointOf(components.all[c].largest_triangle);
    }
    complain(report_.misplaced_components, "part", first,
             "in another part, wholly or partly, or inside out; unite the parts (boolean union), move them apart, or turn the "
             "walls of hollows inward");
}

} // namespace

Duplicates findDuplicates(const Mesh& mesh, const Components& components) {
    Duplicates found;
    const double largest = largestVolume(components);
    const std::vector<std::array<uint32_t, 2>> coincident = findCoincident(mesh);
    for (size_t k = 0; k < coincident.size(); ++k) {
        const auto& [first, other] = coincident[k];
        const bool is_alone =
            (k == 0 || coincident[k - 1][1] != first) && (k + 1 == coincident.size() || coincident[k + 1][0] != other);
        const bool is_wall = is_alone && facesBack(mesh.triangles[first], mesh.triangles[other]) &&
                             areNeighbors(components, components.of[first], components.of[other], largest);
        if (is_wall)
            ++found.walls;
        else
            found.faulty.push_back(other);
    }
    return found;
}

MeshReport inspectMesh(const Mesh& mesh, const MeshTopology& topology) { return Inspector(mesh, topology).run(); }

engine::Result<MeshReport> checkMesh(const Mesh& mesh, const MeshTopology& topology) {
    MeshReport report = inspectMesh(mesh, topology);
    if (!report.isSound()) return engine::Error{engine::ErrorCode::BadInput, report.problems.front()};
    return report;
}

} // namespace brittle
