#include "modules/brittle/mesh/diagnosis.h"

#include "modules/brittle/mesh/boundary.h"
#include "modules/brittle/mesh/folds.h"
#include "modules/brittle/mesh/repair/orientation.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <numeric>

namespace brittle {
namespace {

class Diagnostician {
public:
    Diagnostician(const Mesh& mesh, const MeshTopology& topology)
        : mesh_(mesh), topology_(topology), uses_(topology), orientation_(findOrientation(mesh, uses_)),
          boundary_(findBoundary(mesh, uses_)) {}
    MeshDiagnosis run();

private:
    void listEdges();
    void listHoles();
    void listTriangles();
    void listDuplicates();
    void listCrossings();
    void listFolds();
    void countParts();
    void countFans();
    void countRims();
    void nameGenus();
    std::vector<uint32_t> fansOfCorners() const;
    Double3 place(const Double3& relative) const { return mesh_.center + relative; }
    MeshDiagnosis::Part& partOf(uint32_t half_edge) { return found_.parts[orientation_.part[half_edge / 3]]; }

    const Mesh& mesh_;
    const MeshTopology& topology_;
    const EdgeUses uses_;
    const Orientation orientation_;
    const Boundary boundary_;
    MeshDiagnosis found_;
};

MeshDiagnosis Diagnostician::run() {
    found_.report = inspectMesh(mesh_, topology_);
    countParts();
    countFans();
    countRims();
    nameGenus();
    listEdges();
    listHoles();
    listTriangles();
    listDuplicates();
    listCrossings();
    listFolds();
    return std::move(found_);
}

void Diagnostician::listFolds() {
    for (const uint32_t edge : findFolds(mesh_, topology_, kTouchDepth * found_.report.measures.diagonal)) {
        const auto& [a, b] = topology_.edges[edge];
        found_.folds.push_back(place(middleOfEdge(mesh_, a, b)));
    }
}

void Diagnostician::countParts() {
    found_.parts.resize(orientation_.part_count);
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const Corners p = cornersOf(mesh_, t);
        MeshDiagnosis::Part& part = partOf(3 * t);
        if (part.triangles++ == 0) part.where = place(middleOf(p));
        part.volume += dot(p[0], cross(p[1], p[2])) / 6;
        part.area += length(doubleArea(p)) / 2;
    }
    for (const uint32_t edge : orientation_.torn)
        partOf(uses_.along(edge).front()).is_one_sided = true;
    // Where sheets pass through an edge each counts it once.
    for (uint32_t h = 0; h < 3 * mesh_.triangles.size(); ++h) {
        const uint32_t mate = topology_.half_edge_mates[h], other = uses_.across(h);
        const uint32_t paired = other != h ? other : mate == kNoMate ? h : mate;
        if (h <= paired) ++partOf(h).edges;
    }
}

// Corners of triangles around a vertex that hang together by edges are one fan: the vertex, as its sheet has it.
std::vector<uint32_t> Diagnostician::fansOfCorners() const {
    std::vector<uint32_t> parent(3 * mesh_.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t c) {
        while (parent[c] != c)
            c = parent[c] = parent[parent[c]];
        return c;
    };
    const auto join = [&](uint32_t a, uint32_t b) {
        const uint32_t ra = root(a), rb = root(b);
        parent[std::max(ra, rb)] = std::min(ra, rb);
    };
    for (uint32_t h = 0; h < parent.size(); ++h) {
        uint32_t other = uses_.across(h);
        if (other == h && topology_.half_edge_mates[h] != kNoMate) other = topology_.half_edge_mates[h];
        if (other == h) continue;
        const bool same_way = startOf(mesh_, h) == startOf(mesh_, other);
        join(h, same_way ? other : nextHalfEdge(other));
        join(nextHalfEdge(h), same_way ? nextHalfEdge(other) : other);
    }
    for (uint32_t c = 0; c < parent.size(); ++c)
        parent[c] = root(c);
    return parent;
}

void Diagnostician::countFans() {
    const std::vector<uint32_t> fans = fansOfCorners();
    std::vector<uint32_t> fans_at(mesh_.positions.size(), 0);
    for (uint32_t corner = 0; corner < fans.size(); ++corner) {
        if (fans[corner] != corner) continue;
        ++partOf(corner).vertices;
        if (++fans_at[startOf(mesh_, corner)] == 2)
            found_.nonmanifold_vertices.push_back(place(toDouble(mesh_.positions[startOf(mesh_, corner)])));
    }
}

void Diagnostician::countRims() {
    std::vector<char> is_counted(3 * mesh_.triangles.size(), 0);
    size_t k = 0;
    for (const BoundaryLoop& loop : boundary_.loops)
        for (const uint32_t h : loop.half_edges) {
            char& counted = is_counted[boundary_.rims[k++]];
            if (!counted) ++partOf(h).rims;
            counted = 1;
        }
}

// By Euler: V - E + F = 2 - 2 genus - rims.
void Diagnostician::nameGenus() {
    for (MeshDiagnosis::Part& part : found_.parts) {
        const int64_t euler = int64_t{part.vertices} - part.edges + part.triangles + part.rims;
        if (!part.is_one_sided && euler <= 2 && euler % 2 == 0) part.genus = static_cast<uint32_t>((2 - euler) / 2);
    }
    // A sheet that ends at an edge of others, or goes on in another part there, branches: no formula holds for it.
    for (uint32_t h = 0; h < 3 * mesh_.triangles.size(); ++h) {
        const uint32_t mate = topology_.half_edge_mates[h];
        const bool goes_on = mate != kNoMate && orientation_.part[mate / 3] == orientation_.part[h / 3];
        if (uses_.along(uses_.edgeOf(h)).size() > 2 && !goes_on) partOf(h).genus.reset();
    }
}

void Diagnostician::listEdges() {
    for (uint32_t e = 0; e < uses_.edgeCount(); ++e) {
        const std::span<const uint32_t> along = uses_.along(e);
        const Double3 where = place(middleOfEdge(mesh_, topology_.edges[e][0], topology_.edges[e][1]));
        if (along.size() > 2) found_.nonmanifold_edges.push_back(where);
        if (along.size() == 2 && startOf(mesh_, along[0]) == startOf(mesh_, along[1]))
            found_.inconsistent_edges.push_back(where);
    }
}

void Diagnostician::listHoles() {
    for (const BoundaryLoop& loop : boundary_.loops) {
        MeshDiagnosis::Hole hole;
        Box box;
        Double3 sum = {0, 0, 0};
        for (const uint32_t h : loop.half_edges) {
            const Double3 a = toDouble(mesh_.positions[startOf(mesh_, h)]), b = toDouble(mesh_.positions[endOf(mesh_, h)]);
            box.grow(a);
            box.grow(b);
            sum += 0.5 * (a + b);
            hole.length += length(b - a);
        }
        hole.edges = static_cast<uint32_t>(loop.half_edges.size());
        hole.diameter = box.diagonal();
        hole.where = place((1.0 / hole.edges) * sum);
        hole.is_simple = loop.is_simple;
        found_.holes.push_back(hole);
    }
}

void Diagnostician::listTriangles() {
    for (uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const Corners p = cornersOf(mesh_, t);
        const double aspect = aspectOf(p);
        if (aspect > kSliverAspect) found_.slivers.push_back({isFlat(p) ? HUGE_VAL : aspect, place(middleOf(p))});
    }
    std::stable_sort(found_.slivers.begin(), found_.slivers.end(),
                     [](const auto& a, const auto& b) { return a.aspect > b.aspect; });
}

void Diagnostician::listDuplicates() {
    for (const uint32_t t : findDuplicates(mesh_, findComponents(mesh_, topology_)).faulty)
        found_.duplicates.push_back(place(middleOf(cornersOf(mesh_, t))));
}

void Diagnostician::listCrossings() {
    for (const Crossing& crossing : found_.report.self_intersection.crossings)
        found_.crossings.push_back({crossing.depth, place(crossing.where), {crossing.first, crossing.second}});
    std::stable_sort(found_.crossings.begin(), found_.crossings.end(),
                     [](const auto& a, const auto& b) { return a.depth > b.depth; });
}

} // namespace

MeshDiagnosis diagnoseMesh(const Mesh& mesh, const MeshTopology& topology) {
    if (mesh.triangles.empty()) return {inspectMesh(mesh, topology), {}, {}, {}, {}, {}, {}, {}, {}};
    return Diagnostician(mesh, topology).run();
}

} // namespace brittle
