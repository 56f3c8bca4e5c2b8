#include "modules/brittle/mesh/repair/hole_filling.h"

#include "modules/brittle/mesh/boundary.h"
#include "modules/brittle/mesh/repair/mesh_edit.h"
#include "modules/brittle/mesh/repair/orientation.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <limits>
#include <numbers>
#include <set>

namespace brittle {
namespace {

using Edge = std::array<uint32_t, 2>;

Edge edgeBetween(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct Rim {
    std::vector<Double3> corners; // in the direction of the triangles around; the filling runs the other way
    std::vector<Double3> behind;  // the third corner of the triangle at the edge from each corner to the next
};

// Dynamic programming over the stretches of the rim from corner i to corner j, closed by the chord between them.
class RimTriangulation {
public:
    // may_join[i * n + j]: the chord from i to j is free or part of the rim.
    RimTriangulation(const Rim& rim, std::vector<char> may_join)
        : rim_(rim), count_(rim.corners.size()), may_join_(std::move(may_join)), stretches_(count_ * count_) {}
    std::vector<Index3> run(); // empty where there is none

private:
    static constexpr int kImpossible = std::numeric_limits<int>::max();
    struct Stretch {
        int fold = 0;      // the sharpest, in steps: what folds about the same is told apart by sides
        double sides = 0;  // squares of all of them
        uint32_t apex = 0; // of the triangle at the chord
    };
    Stretch& at(size_t i, size_t j) { return stretches_[i * count_ + j]; }
    Corners triangle(size_t i, size_t m, size_t j) const { return {rim_.corners[i], rim_.corners[j], rim_.corners[m]}; }
    Corners beyond(size_t i, size_t j);
    Stretch best(size_t i, size_t j);
    void collect(size_t i, size_t j, std::vector<Index3>& triangles);

    const Rim& rim_;
    size_t count_;
    std::vector<char> may_join_;
    std::vector<Stretch> stretches_;
};

// The angle between the fronts, in steps of about a degree. What has no area folds as sharply as can be.
int foldBetween(const Corners& a, const Corners& b) {
    const Double3 n = doubleArea(a), m = doubleArea(b);
    const double angle = isFlat(a) || isFlat(b) ? std::numbers::pi : std::atan2(length(cross(n, m)), dot(n, m));
    return static_cast<int>(angle * 57);
}

// The triangle on the rim's side of the chord.
Corners RimTriangulation::beyond(size_t i, size_t j) {
    if (j == i + 1) return {rim_.corners[i], rim_.corners[j], rim_.behind[i]};
    return triangle(i, at(i, j).apex, j);
}

RimTriangulation::Stretch RimTriangulation::best(size_t i, size_t j) {
    Stretch best{kImpossible, 0, 0};
    if (!may_join_[i * count_ + j]) return best;
    for (size_t m = i + 1; m < j; ++m) {
        const Stretch &left = at(i, m), &right = at(m, j);
        if (left.fold == kImpossible || right.fold == kImpossible) continue;
        const Corners added = triangle(i, m, j);
        int fold = std::max({left.fold, right.fold, foldBetween(added, beyond(i, m)), foldBetween(added, beyond(m, j))});
        if (i == 0 && j + 1 == count_) // the last chord is an edge of the rim as well
            fold = std::max(fold, foldBetween(added, {rim_.corners[j], rim_.corners[i], rim_.behind[j]}));
        const Double3 a = added[1] - added[0], b = added[2] - added[1], c = added[0] - added[2];
        const double sides = left.sides + right.sides + dot(a, a) + dot(b, b) + dot(c, c);
        if (fold < best.fold || (fold == best.fold && sides < best.sides)) best = {fold, sides, static_cast<uint32_t>(m)};
    }
    return best;
}

std::vector<Index3> RimTriangulation::run() {
    for (size_t span = 2; span < count_; ++span)
        for (size_t i = 0; i + span < count_; ++i)
            at(i, i + span) = best(i, i + span);
    std::vector<Index3> triangles;
    if (at(0, count_ - 1).fold != kImpossible) collect(0, count_ - 1, triangles);
    return triangles;
}

void RimTriangulation::collect(size_t i, size_t j, std::vector<Index3>& triangles) {
    if (j < i + 2) return;
    const uint32_t m = at(i, j).apex;
    triangles.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(j), m});
    collect(i, m, triangles);
    collect(m, j, triangles);
}

class HoleFiller {
public:
    HoleFiller(Mesh& mesh, double diagonal)
        : mesh_(mesh), diagonal_(diagonal), topology_(buildTopology(mesh)), uses_(topology_),
          parts_(findOrientation(mesh, uses_)), areas_(parts_.part_count, 0) {
        for (size_t t = 0; t < mesh.triangles.size(); ++t)
            areas_[parts_.part[t]] += length(doubleArea(cornersOf(mesh, t)));
    }
    HoleFilling run();

private:
    const char* whyNot(const BoundaryLoop& loop, double diameter) const;
    const char* fill(const BoundaryLoop& loop); // says why not, nullptr when done
    void add(const BoundaryLoop& loop, const std::vector<Index3>& triangles);
    bool exists(const Edge& edge) const {
        return std::binary_search(topology_.edges.begin(), topology_.edges.end(), edge) || added_.contains(edge);
    }
    RepairNotes::Hole describe(const BoundaryLoop& loop) const;
    std::vector<char> freeChords(const BoundaryLoop& loop) const;

    Mesh& mesh_;
    double diagonal_;
    const MeshTopology topology_; // before anything was filled
    const EdgeUses uses_;
    const Orientation parts_;
    std::vector<double> areas_; // of every part, doubled
    std::set<Edge> added_;
};

HoleFilling HoleFiller::run() {
    constexpr uint64_t kMaxWork = 4'000'000'000; // five hundred of the largest, or a million of sixteen edges
    HoleFilling result;
    uint64_t work = 0;
    for (const BoundaryLoop& loop : findBoundary(mesh_, uses_).loops) {
        const RepairNotes::Hole hole = describe(loop);
        const char* why = whyNot(loop, hole.diameter);
        if (!why) work += uint64_t{hole.edges} * hole.edges * hole.edges;
        if (!why && work > kMaxWork) why = "is one too many to be closed in reasonable time";
        if (!why) why = fill(loop);
        if (why)
            result.left.push_back({hole, why});
        else
            result.closed.push_back(hole);
    }
    return result;
}

RepairNotes::Hole HoleFiller::describe(const BoundaryLoop& loop) const {
    Box box;
    Double3 sum = {0, 0, 0};
    for (const uint32_t h : loop.half_edges) {
        box.grow(toDouble(mesh_.positions[startOf(mesh_, h)]));
        box.grow(toDouble(mesh_.positions[endOf(mesh_, h)]));
        sum += middleOfEdge(mesh_, startOf(mesh_, h), endOf(mesh_, h));
    }
    const auto count = static_cast<uint32_t>(loop.half_edges.size());
    return {count, box.diagonal(), (1.0 / count) * sum};
}

const char* HoleFiller::whyNot(const BoundaryLoop& loop, double diameter) const {
    if (!loop.is_simple) return "has a rim that is not a simple loop";
    for (size_t k = 0; k < loop.half_edges.size(); ++k)
        if (endOf(mesh_, loop.half_edges[k]) != startOf(mesh_, loop.half_edges[(k + 1) % loop.half_edges.size()]))
            return "has a rim along which the surface turns over";
    const size_t edges = loop.half_edges.size();
    if (edges <= kFewHoleEdges || (edges <= kMaxHoleEdges && diameter <= kMaxHoleDiameter * diagonal_)) return nullptr;
    return "is too large to be closed without guessing";
}

std::vector<char> HoleFiller::freeChords(const BoundaryLoop& loop) const {
    const size_t count = loop.half_edges.size();
    std::vector<char> free(count * count, 0);
    for (size_t i = 0; i < count; ++i)
        for (size_t j = i + 1; j < count; ++j) {
            const bool is_rim = j == i + 1 || (i == 0 && j + 1 == count);
            const Edge chord = edgeBetween(startOf(mesh_, loop.half_edges[i]), startOf(mesh_, loop.half_edges[j]));
            free[i * count + j] = is_rim || !exists(chord) ? 1 : 0;
        }
    return free;
}

const char* HoleFiller::fill(const BoundaryLoop& loop) {
    constexpr const char* kDoubling = "cannot be closed without doubling what is there";
    const std::vector<uint32_t>& h = loop.half_edges;
    if (h.size() == 3 && h[0] / 3 == h[1] / 3 && h[1] / 3 == h[2] / 3) return kDoubling; // a triangle on its own
    Rim rim;
    for (const uint32_t half_edge : h) {
        rim.corners.push_back(toDouble(mesh_.positions[startOf(mesh_, half_edge)]));
        rim.behind.push_back(toDouble(mesh_.positions[startOf(mesh_, previousHalfEdge(half_edge))]));
    }
    const std::vector<Index3> triangles = RimTriangulation(rim, freeChords(loop)).run();
    if (triangles.empty()) return kDoubling;
    double area = 0;
    for (const Index3& t : triangles)
        area += length(doubleArea({rim.corners[t[0]], rim.corners[t[1]], rim.corners[t[2]]}));
    if (area > kMaxHoleShare * areas_[parts_.part[h[0] / 3]]) return "is the rim of a sheet, which has no inside";
    add(loop, triangles);
    return nullptr;
}

void HoleFiller::add(const BoundaryLoop& loop, const std::vector<Index3>& triangles) {
    const std::vector<uint32_t>& h = loop.half_edges;
    for (const Index3& t : triangles) {
        std::array<MeshCorner, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = cornerOf(mesh_, h[t[k]]);
            corners[k].normal = {0, 0, 0};
            added_.insert(edgeBetween(startOf(mesh_, h[t[k]]), startOf(mesh_, h[t[(k + 1) % 3]])));
        }
        appendTriangle(mesh_, corners[0], corners[1], corners[2]);
    }
}

} // namespace

HoleFilling fillHoles(Mesh& mesh, double diagonal) { return HoleFiller(mesh, diagonal).run(); }

} // namespace brittle
