#include "modules/brittle/mesh/repair/seams.h"

#include "modules/brittle/mesh/half_edge.h"
#include "modules/brittle/mesh/repair/mesh_edit.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"
#include "modules/brittle/mesh/triangle_tree.h"

#include <numeric>
#include <unordered_map>

namespace brittle {
namespace {

constexpr double kGap = 4;       // how many times further than kSeamWidth other vertices have to be
constexpr size_t kMaxCrowd = 64; // vertices in one cell: more are no seam

std::vector<uint32_t> openHalfEdges(const Mesh& mesh, const EdgeUses& uses) {
    std::vector<uint32_t> open;
    for (uint32_t h = 0; h < 3 * mesh.triangles.size(); ++h)
        if (uses.isOpen(h)) open.push_back(h);
    return open;
}

std::vector<uint32_t> openVertices(const Mesh& mesh, std::span<const uint32_t> open) {
    std::vector<uint32_t> vertices;
    for (const uint32_t h : open) {
        vertices.push_back(startOf(mesh, h));
        vertices.push_back(endOf(mesh, h));
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// ---- vertices -------------------------------------------------------------------------------------------------------------

// Clusters of near vertices, by union-find. One that is too wide, has a stranger nearby or holds a whole edge is not joined.
class SeamJoiner {
public:
    SeamJoiner(Mesh& mesh, std::vector<uint32_t> vertices, double width)
        : mesh_(mesh), vertices_(std::move(vertices)), width_(width), parent_(mesh.positions.size()),
          is_spoiled_(mesh.positions.size(), 0) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::vector<Double3> run();

private:
    using Cell = std::array<int64_t, 3>;
    struct CellHash {
        size_t operator()(const Cell& c) const {
            uint64_t h = 0;
            for (const int64_t x : c)
                h = (h ^ static_cast<uint64_t>(x)) * 0x9E3779B97F4A7C15u, h ^= h >> 31;
            return h;
        }
    };
    Cell cellOf(uint32_t vertex) const;
    void sortIntoCells();
    template <class Visit>
    void forEachNearPair(const Visit& visit) const;
    void spoilWide();
    void spoilWholeEdges();
    uint32_t root(uint32_t vertex);
    double distance(uint32_t a, uint32_t b) const {
        return length(toDouble(mesh_.positions[a]) - toDouble(mesh_.positions[b]));
    }

    Mesh& mesh_;
    std::vector<uint32_t> vertices_;
    double width_;
    std::vector<uint32_t> parent_;
    std::vector<char> is_spoiled_; // of every root
    std::unordered_map<Cell, std::vector<uint32_t>, CellHash> cells_;
};

std::vector<Double3> SeamJoiner::run() {
    sortIntoCells();
    forEachNearPair([&](uint32_t a, uint32_t b) {
        if (distance(a, b) > width_) return;
        const uint32_t ra = root(a), rb = root(b);
        parent_[std::max(ra, rb)] = std::min(ra, rb);
    });
    forEachNearPair([&](uint32_t a, uint32_t b) {
        if (root(a) != root(b) && distance(a, b) <= kGap * width_) is_spoiled_[root(a)] = is_spoiled_[root(b)] = 1;
    });
    spoilWide();
    spoilWholeEdges();
    std::vector<Double3> joined;
    for (const uint32_t v : vertices_)
        if (root(v) != v && !is_spoiled_[root(v)]) joined.push_back(toDouble(mesh_.positions[v]));
    for (Index3& t : mesh_.triangles)
        for (uint32_t& v : t)
            if (!is_spoiled_[root(v)]) v = root(v);
    return joined;
}

SeamJoiner::Cell SeamJoiner::cellOf(uint32_t vertex) const {
    Cell cell;
    for (size_t c = 0; c < 3; ++c)
        cell[c] = static_cast<int64_t>(std::floor(static_cast<double>(mesh_.positions[vertex][c]) / (kGap * width_)));
    return cell;
}

void SeamJoiner::sortIntoCells() {
    for (const uint32_t v : vertices_)
        cells_[cellOf(v)].push_back(v);
    std::erase_if(cells_, [](const auto& entry) { return entry.second.size() > kMaxCrowd; });
}

template <class Visit>
void SeamJoiner::forEachNearPair(const Visit& visit) const {
    for (const uint32_t v : vertices_) {
        const Cell own = cellOf(v);
        for (int64_t n = 0; n < 27; ++n) {
            const auto found = cells_.find({own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1});
            if (found == cells_.end()) continue;
            for (const uint32_t w : found->second)
                if (v < w) visit(v, w);
        }
    }
}

void SeamJoiner::spoilWide() {
    std::unordered_map<uint32_t, Box> boxes;
    for (const uint32_t v : vertices_)
        boxes[root(v)].grow(toDouble(mesh_.positions[v]));
    for (const auto& [cluster, box] : boxes)
        if (box.diagonal() > width_) is_spoiled_[cluster] = 1;
}

void SeamJoiner::spoilWholeEdges() {
    for (const Index3& t : mesh_.triangles)
        for (size_t k = 0; k < 3; ++k)
            if (root(t[k]) == root(t[(k + 1) % 3])) is_spoiled_[root(t[k])] = 1;
}

uint32_t SeamJoiner::root(uint32_t vertex) {
    while (parent_[vertex] != vertex)
        vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
}

// ---- edges ----------------------------------------------------------------------------------------------------------------

struct PointOnEdge {
    uint32_t half_edge, vertex;
    double along; // 0 to 1
};

// Only well inside the edge: what is near its ends is a matter of joining vertices.
void noteIfOnEdge(const Mesh& mesh, uint32_t half_edge, uint32_t vertex, double width, std::vector<PointOnEdge>& found) {
    const Index3& own = mesh.triangles[half_edge / 3];
    if (vertex == own[0] || vertex == own[1] || vertex == own[2]) return;
    const Double3 a = toDouble(mesh.positions[startOf(mesh, half_edge)]), b = toDouble(mesh.positions[endOf(mesh, half_edge)]);
    const Double3 p = toDouble(mesh.positions[vertex]), along = b - a;
    const double squared = dot(along, along), at = dot(p - a, along);
    if (length(p - a) <= 2 * width || length(p - b) <= 2 * width || at <= 0 || at >= squared) return;
    if (length(p - a - (at / squared) * along) <= width) found.push_back({half_edge, vertex, at / squared});
}

// Boxes of edges first, then those of vertices, a little larger than they are.
std::vector<TriangleTree::Bounds> boundsOf(const Mesh& mesh, std::span<const uint32_t> open, std::span<const uint32_t> vertices,
                                           double width) {
    std::vector<TriangleTree::Bounds> bounds(open.size() + vertices.size());
    const auto margin = static_cast<float>(2 * width);
    const auto grow = [&](TriangleTree::Bounds& box, uint32_t vertex) {
        const Float3& p = mesh.positions[vertex];
        box.grow({{p[0] - margin, p[1] - margin, p[2] - margin}, {p[0] + margin, p[1] + margin, p[2] + margin}});
    };
    for (size_t k = 0; k < open.size(); ++k) {
        grow(bounds[k], startOf(mesh, open[k]));
        grow(bounds[k], endOf(mesh, open[k]));
    }
    for (size_t k = 0; k < vertices.size(); ++k)
        grow(bounds[open.size() + k], vertices[k]);
    return bounds;
}

std::vector<PointOnEdge> findPointsOnEdges(const Mesh& mesh, double width) {
    const MeshTopology topology = buildTopology(mesh);
    const std::vector<uint32_t> open = openHalfEdges(mesh, EdgeUses(topology)), vertices = openVertices(mesh, open);
    if (open.empty()) return {};
    std::vector<PointOnEdge> found;
    uint64_t tests = 0;
    constexpr uint64_t kMaxTests = 100'000'000; // more are no seams but a heap of edges
    const size_t max_found = 4 * open.size() + 16;
    TriangleTree(boundsOf(mesh, open, vertices, width)).forEachPair([&](uint32_t a, uint32_t b) {
        if (a < open.size() && b >= open.size()) noteIfOnEdge(mesh, open[a], vertices[b - open.size()], width, found);
        return ++tests < kMaxTests && found.size() <= max_found;
    });
    if (tests >= kMaxTests || found.size() > max_found) return {};
    std::sort(found.begin(), found.end(), [](const PointOnEdge& a, const PointOnEdge& b) {
        return a.half_edge != b.half_edge ? a.half_edge < b.half_edge
               : a.along != b.along       ? a.along < b.along
                                          : a.vertex < b.vertex;
    });
    return found;
}

MeshCorner between(const MeshCorner& a, const MeshCorner& b, const PointOnEdge& point) {
    const auto s = static_cast<float>(point.along);
    MeshCorner corner{point.vertex, {0, 0, 0}, {0, 0}};
    for (size_t c = 0; c < 3; ++c)
        corner.normal[c] = (1 - s) * a.normal[c] + s * b.normal[c];
    for (size_t c = 0; c < 2; ++c)
        corner.uv[c] = (1 - s) * a.uv[c] + s * b.uv[c];
    return corner;
}

// A fan from the corner across the edge.
void splitTriangle(Mesh& mesh, uint32_t half_edge, std::span<const PointOnEdge> points) {
    MeshCorner from = cornerOf(mesh, half_edge);
    const MeshCorner first = from, to = cornerOf(mesh, nextHalfEdge(half_edge)),
                     apex = cornerOf(mesh, previousHalfEdge(half_edge));
    for (const PointOnEdge& point : points) {
        const MeshCorner middle = between(first, to, point);
        if (point.vertex == points.front().vertex)
            replaceTriangle(mesh, half_edge / 3, from, middle, apex);
        else
            appendTriangle(mesh, from, middle, apex);
        from = middle;
    }
    appendTriangle(mesh, from, to, apex);
}

// One edge of every triangle at a time. True where something was split.
bool splitOnce(Mesh& mesh, double width, std::vector<Double3>& where) {
    const std::vector<PointOnEdge> found = findPointsOnEdges(mesh, width);
    uint32_t last_triangle = kNoMate;
    for (size_t first = 0, last = 0; first < found.size(); first = last) {
        while (last < found.size() && found[last].half_edge == found[first].half_edge)
            ++last;
        const uint32_t h = found[first].half_edge;
        if (h / 3 == last_triangle) continue;
        last_triangle = h / 3;
        where.push_back(middleOfEdge(mesh, startOf(mesh, h), endOf(mesh, h)));
        splitTriangle(mesh, h, std::span(found).subspan(first, last - first));
    }
    return !found.empty();
}

} // namespace

std::vector<Double3> joinSeams(Mesh& mesh, double diagonal) {
    const MeshTopology topology = buildTopology(mesh);
    const std::vector<uint32_t> open = openHalfEdges(mesh, EdgeUses(topology));
    if (open.empty()) return {};
    return SeamJoiner(mesh, openVertices(mesh, open), kSeamWidth * diagonal).run();
}

std::vector<Double3> dropLooseFlat(Mesh& mesh) {
    std::vector<Double3> dropped;
    for (size_t before = 1; before != dropped.size() + 1;) {
        before = dropped.size() + 1;
        const MeshTopology topology = buildTopology(mesh);
        const EdgeUses uses(topology);
        std::vector<char> keep(mesh.triangles.size(), 1);
        for (uint32_t t = 0; t < keep.size(); ++t) {
            const Corners corners = cornersOf(mesh, t);
            const bool is_loose = uses.along(uses.edgeOf(3 * t)).size() % 2 != 0 ||
                                  uses.along(uses.edgeOf(3 * t + 1)).size() % 2 != 0 ||
                                  uses.along(uses.edgeOf(3 * t + 2)).size() % 2 != 0;
            if (!is_loose || !isFlat(corners)) continue;
            keep[t] = 0;
            dropped.push_back(middleOf(corners));
        }
        keepTriangles(mesh, keep);
    }
    return dropped;
}

std::vector<Double3> splitJunctions(Mesh& mesh, double diagonal) {
    std::vector<Double3> where;
    constexpr int kMaxRounds = 4; // three edges of a triangle, and one to see that nothing is left
    for (int round = 0; round < kMaxRounds && splitOnce(mesh, kJunctionWidth * diagonal, where); ++round) {
    }
    return where;
}

} // namespace brittle
