#include "modules/brittle/fracture/verify.h"

#include "engine/check.h"
#include "modules/brittle/fracture/site_grid.h"
#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace brittle {
namespace {

// One number per position over all fragments, by open addressing on the bits. -0 and 0 are one.
class PositionNumbers {
public:
    explicit PositionNumbers(const std::vector<FragmentVertex>& vertices)
        : vertices_(vertices), slots_(std::bit_ceil(2 * vertices.size() + 2), kEmpty), numbers_(vertices.size()) {
        for (uint32_t v = 0; v < vertices.size(); ++v)
            numbers_[v] = find(v);
    }
    // The first vertex of all that stand where this one does.
    uint32_t operator[](size_t vertex) const { return numbers_[vertex]; }

private:
    static constexpr uint32_t kEmpty = 0xffffffff;

    uint32_t find(uint32_t v) {
        uint64_t hash = 0;
        for (const float x : vertices_[v].position) {
            hash = (hash ^ std::bit_cast<uint32_t>(x + 0.0f)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 29;
        }
        for (size_t slot = hash;; ++slot) {
            uint32_t& entry = slots_[slot & (slots_.size() - 1)];
            if (entry == kEmpty) return entry = v; // at once: what is no number equals nothing, not even itself
            if (std::equal(vertices_[v].position, vertices_[v].position + 3, vertices_[entry].position)) return entry;
        }
    }
    const std::vector<FragmentVertex>& vertices_;
    std::vector<uint32_t> slots_;
    std::vector<uint32_t> numbers_;
};

struct HalfEdge {
    uint32_t low, high;
    uint32_t triangle;
    int32_t direction; // +1 from low to high
    bool isAlong(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

struct InnerTriangle {
    Index3 corners; // ascending
    uint32_t fragment;
    int32_t turn; // +1 or -1: which way round they are walked
};

bool isCollapsed(const Index3& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

InnerTriangle innerTriangle(Index3 corners, uint32_t fragment) {
    int32_t turn = 1;
    const auto order = [&](size_t a, size_t b) {
        if (corners[a] <= corners[b]) return;
        std::swap(corners[a], corners[b]);
        turn = -turn;
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return {corners, fragment, turn};
}

class Verifier {
public:
    Verifier(const MeshMeasures& model, const FragmentSet& set, std::span<const Double3> sites);
    ContractReport run();

private:
    void readFragment(uint32_t f);
    void sortHalfEdges();
    void checkEdges();
    void checkParts();
    void checkMeasures(const Fragment& fragment);
    void checkCell(const Fragment& fragment);
    void checkInner();
    bool isTurnedOver(const InnerTriangle& triangle, uint32_t behind) const;
    // How far apart what is one place may have come to lie, corners being in single precision.
    double rounding() const { return std::ldexp(4 * model_.diagonal, -23); }
    void checkSums();
    Double3 corner(uint32_t vertex) const { return positionOf(set_.vertices[vertex]); }

    const MeshMeasures& model_;
    const FragmentSet& set_;
    std::vector<Double3> sites_; // in the fragments' frame
    SiteGrid grid_;
    PositionNumbers numbers_;
    ContractReport report_;
    double volume_ = 0, outer_area_ = 0;
    Double3 moment_ = {0, 0, 0};
    std::vector<InnerTriangle> inner_; // of all fragments
    // Of the current fragment.
    std::vector<Index3> triangles_;
    std::vector<HalfEdge> edges_;
    std::vector<uint32_t> near_;
};

std::vector<Double3> relativeTo(const Double3& center, std::span<const Double3> points) {
    std::vector<Double3> relative;
    for (const Double3& p : points)
        relative.push_back(p - center);
    return relative;
}

Verifier::Verifier(const MeshMeasures& model, const FragmentSet& set, std::span<const Double3> sites)
    : model_(model), set_(set), sites_(relativeTo(set.center, sites)), grid_(sites_), numbers_(set.vertices) {}

ContractReport Verifier::run() {
    for (uint32_t f = 0; f < set_.fragments.size(); ++f) {
        readFragment(f);
        sortHalfEdges();
        checkEdges();
        checkParts();
        checkMeasures(set_.fragments[f]);
        checkCell(set_.fragments[f]);
    }
    checkInner();
    checkSums();
    return report_;
}

// Corners by the number of their position; triangles that have collapsed enclose nothing and are left out.
void Verifier::readFragment(uint32_t f) {
    const Fragment& fragment = set_.fragments[f];
    triangles_.clear();
    const uint32_t count = fragment.outer_index_count + fragment.inner_index_count;
    for (uint32_t k = 0; k < count; k += 3) {
        Index3 t;
        for (uint32_t c = 0; c < 3; ++c)
            t[c] = numbers_[fragment.first_vertex + set_.indices[fragment.first_index + k + c]];
        if (isCollapsed(t)) continue;
        triangles_.push_back(t);
        if (k >= fragment.outer_index_count) inner_.push_back(innerTriangle(t, f));
    }
}

void Verifier::sortHalfEdges() {
    edges_.clear();
    for (uint32_t t = 0; t < triangles_.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = triangles_[t][k], to = triangles_[t][(k + 1) % 3];
            edges_.push_back({std::min(from, to), std::max(from, to), t, from < to ? 1 : -1});
        }
    std::sort(edges_.begin(), edges_.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
}

void Verifier::checkEdges() {
    for (size_t first = 0, k = 0; first < edges_.size(); first = k) {
        int32_t balance = 0;
        for (; k < edges_.size() && edges_[k].isAlong(edges_[first]); ++k)
            balance += edges_[k].direction;
        report_.open_edges += balance != 0 ? 1 : 0;
    }
}

// Parts hang together by edges. One of them encloses the fragment, the others can only be walls of cavities. Where these lie on
// each other, which side they turn inward is rounding.
void Verifier::checkParts() {
    std::vector<uint32_t> parent(triangles_.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t t) {
        while (parent[t] != t)
            t = parent[t] = parent[parent[t]];
        return t;
    };
    for (size_t k = 1; k < edges_.size(); ++k)
        if (edges_[k].isAlong(edges_[k - 1])) parent[root(edges_[k].triangle)] = root(edges_[k - 1].triangle);
    std::vector<double> volume(triangles_.size(), 0), area(triangles_.size(), 0);
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
        const uint32_t part = root(t);
        const Double3 origin = corner(triangles_[part][0]); // near, so that small parts keep their sign
        const Double3 a = corner(triangles_[t][0]) - origin, b = corner(triangles_[t][1]) - origin,
                      c = corner(triangles_[t][2]) - origin;
        volume[part] += dot(a, cross(b, c)) / 6;
        area[part] += length(cross(b - a, c - a)) / 2;
    }
    const auto outer = static_cast<size_t>(std::ranges::max_element(volume) - volume.begin());
    bool is_one = !volume.empty() && volume[outer] > 0;
    for (size_t part = 0; part < volume.size(); ++part)
        is_one = is_one && (part == outer || volume[part] <= rounding() * area[part] / 2);
    report_.parted_fragments += is_one ? 0 : 1;
}

void Verifier::checkMeasures(const Fragment& fragment) {
    double six_volumes = 0;
    const auto at = [&](uint32_t k) { return corner(fragment.first_vertex + set_.indices[fragment.first_index + k]); };
    const uint32_t count = fragment.outer_index_count + fragment.inner_index_count;
    for (uint32_t k = 0; k < count; k += 3) {
        const Double3 a = at(k), b = at(k + 1), c = at(k + 2);
        const double part = dot(a, cross(b, c));
        six_volumes += part;
        moment_ += part * (a + b + c);
        if (k < fragment.outer_index_count) outer_area_ += length(cross(b - a, c - a)) / 2;
    }
    volume_ += six_volumes / 6;
    report_.hollow_fragments += six_volumes > 0 ? 0 : 1;
}

// A site further from the own one than twice the furthest vertex cannot claim any of them.
void Verifier::checkCell(const Fragment& fragment) {
    ENGINE_ASSERT(fragment.cell < sites_.size());
    const Double3& own = sites_[fragment.cell];
    double reach = 0;
    for (uint32_t v = 0; v < fragment.vertex_count; ++v)
        reach = std::max(reach, length(corner(fragment.first_vertex + v) - own));
    if (!std::isfinite(reach)) return; // the volume error tells
    near_.clear();
    grid_.findNear(own, 2 * reach, near_);
    for (const uint32_t other : near_) {
        const Double3 apart = sites_[other] - own;
        const double distance = length(apart);
        if (distance == 0) continue;
        for (uint32_t v = 0; v < fragment.vertex_count; ++v) {
            const double beyond = dot(corner(fragment.first_vertex + v) - own, apart) / distance - distance / 2;
            report_.outside_cell = std::max(report_.outside_cell, beyond / model_.diagonal);
        }
    }
}

// A fragment's own triangles must not pair up with each other.
void Verifier::checkInner() {
    std::sort(inner_.begin(), inner_.end(), [](const InnerTriangle& a, const InnerTriangle& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.fragment < b.fragment;
    });
    for (size_t first = 0, k = 0; first < inner_.size(); first = k) {
        uint64_t one_sided = 0;
        int64_t balance = 0;
        report_.turned_inner_triangles += first + 1 < inner_.size() && inner_[first].corners == inner_[first + 1].corners &&
                                          isTurnedOver(inner_[first], inner_[first + 1].fragment);
        while (k < inner_.size() && inner_[k].corners == inner_[first].corners) {
            const uint32_t fragment = inner_[k].fragment;
            int64_t own = 0;
            for (; k < inner_.size() && inner_[k].corners == inner_[first].corners && inner_[k].fragment == fragment; ++k)
                own += inner_[k].turn;
            balance += own;
            one_sided += static_cast<uint64_t>(std::abs(own));
        }
        report_.unpaired_inner_triangles += static_cast<uint64_t>(std::abs(balance)) + (k - first - one_sided);
    }
}

// Corners are rounded to single precision, which may turn over a triangle that is thinner than that.
bool Verifier::isTurnedOver(const InnerTriangle& triangle, uint32_t behind) const {
    const Double3 a = corner(triangle.corners[0]), b = corner(triangle.corners[1]), c = corner(triangle.corners[2]);
    const Double3 way = sites_[set_.fragments[behind].cell] - sites_[set_.fragments[triangle.fragment].cell];
    const double height = triangle.turn * dot(cross(b - a, c - a), way);
    return height < -rounding() * (length(b - a) + length(c - b) + length(a - c)) * length(way);
}

void Verifier::checkSums() {
    report_.volume_error = std::abs(volume_ - model_.volume) / model_.volume;
    report_.area_error = std::abs(outer_area_ - model_.area) / model_.area;
    const Double3 centroid = (1 / (24 * model_.volume)) * moment_;
    report_.centroid_error = length(centroid - model_.centroid) / model_.diagonal;
}

} // namespace

std::string ContractReport::violation() const {
    const auto too_many = [](uint64_t count, const char* what) { return std::to_string(count) + " " + what; };
    if (open_edges > 0) return too_many(open_edges, "open edges");
    if (unpaired_inner_triangles > 0) return too_many(unpaired_inner_triangles, "unpaired inner triangles");
    if (turned_inner_triangles > 0) return too_many(turned_inner_triangles, "inner triangles that are turned over");
    if (hollow_fragments > 0) return too_many(hollow_fragments, "fragments without positive volume");
    if (parted_fragments > 0) return too_many(parted_fragments, "fragments that are not one connected solid");
    // Written so that what is not a number counts as too large.
    const auto too_large = [](double value, double allowed, const char* what) {
        return value <= allowed ? "" : std::string(what) + " of " + formatNumber(value) + ", allowed " + formatNumber(allowed);
    };
    for (const std::string& problem :
         {too_large(volume_error, kMaxVolumeError, "a volume error"), too_large(area_error, kMaxAreaError, "an area error"),
          too_large(centroid_error, kMaxCentroidError, "a centroid error"),
          too_large(outside_cell, kMaxOutsideCell, "a vertex outside its cell by a share")})
        if (!problem.empty()) return problem;
    return "";
}

ContractReport verifyContract(const Mesh& mesh, const MeshMeasures& measures, const FragmentSet& fragments,
                              std::span<const Double3> sites) {
    // Fragments in a frame of their own would add up to the model all the same.
    ContractReport report = Verifier(measures, fragments, sites).run();
    report.centroid_error += length(fragments.center - mesh.center) / measures.diagonal;
    return report;
}

} // namespace brittle
