#include "modules/brittle/mesh/topology.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace brittle {
namespace {

struct HalfEdge {
    uint32_t low, high;
    uint32_t index; // 3 * triangle + corner it starts from
    bool runs_up;   // from low to high
};

HalfEdge halfEdge(const Mesh& mesh, uint32_t index) {
    const Index3& t = mesh.triangles[index / 3];
    const uint32_t from = t[index % 3], to = t[(index + 1) % 3];
    return {std::min(from, to), std::max(from, to), index, from < to};
}

// By low vertex, then high, then index: a counting sort, then a comparison sort of the few at each vertex.
std::vector<HalfEdge> sortedHalfEdges(const Mesh& mesh) {
    const auto count = static_cast<uint32_t>(3 * mesh.triangles.size());
    std::vector<uint32_t> first(mesh.positions.size() + 1, 0);
    for (uint32_t h = 0; h < count; ++h)
        ++first[halfEdge(mesh, h).low + 1];
    for (size_t v = 1; v < first.size(); ++v)
        first[v] += first[v - 1];
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    std::vector<HalfEdge> sorted(count);
    for (uint32_t h = 0; h < count; ++h) {
        const HalfEdge edge = halfEdge(mesh, h);
        sorted[next[edge.low]++] = edge;
    }
    const auto before = [](const HalfEdge& a, const HalfEdge& b) {
        return a.high != b.high ? a.high < b.high : a.index < b.index;
    };
    for (size_t v = 0; v + 1 < first.size(); ++v)
        std::sort(sorted.begin() + first[v], sorted.begin() + first[v + 1], before);
    return sorted;
}

// Half-edges of one edge, turned around it.
struct Spoke {
    double angle;
    double tolerance; // of the angle, for corners are rounded
    bool opens;       // the solid lies on the side of greater angles
    uint32_t index;
};

// Solids that touch may have faces that lie on each other but for rounding. There, one solid ends before the next begins.
void putEndsFirst(std::vector<Spoke>& spokes) {
    for (size_t first = 0, last = 0; first < spokes.size(); first = last) {
        for (last = first + 1; last < spokes.size(); ++last)
            if (spokes[last].angle - spokes[last - 1].angle > spokes[last].tolerance + spokes[last - 1].tolerance) break;
        std::stable_sort(spokes.begin() + static_cast<ptrdiff_t>(first), spokes.begin() + static_cast<ptrdiff_t>(last),
                         [](const Spoke& a, const Spoke& b) { return a.opens != b.opens ? b.opens : a.index < b.index; });
    }
}

// `rounding` is how far corners may be from where they should be.
std::vector<Spoke> sortedSpokes(const Mesh& mesh, std::span<const HalfEdge> around, double rounding) {
    const Double3 low = toDouble(mesh.positions[around[0].low]), high = toDouble(mesh.positions[around[0].high]);
    const Double3 axis = normalized(high - low, {0, 0, 1});
    // Any direction across the axis will do as the zero of angles.
    const Double3 helper = std::abs(axis[0]) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 u = normalized(cross(axis, helper), {1, 0, 0}), v = cross(axis, u);
    std::vector<Spoke> spokes;
    for (const HalfEdge& edge : around) {
        const uint32_t apex = mesh.triangles[edge.index / 3][(edge.index % 3 + 2) % 3];
        const Double3 arm = toDouble(mesh.positions[apex]) - low;
        // The normal of a triangle that runs up points to greater angles, away from the solid.
        const double along = dot(arm, u), aside = dot(arm, v), reach = std::hypot(along, aside);
        const double tolerance = reach > 0 ? rounding / reach : 0;
        double angle = std::atan2(aside, along);
        if (angle < -std::numbers::pi + tolerance) angle += 2 * std::numbers::pi; // beside those at half a turn
        spokes.push_back({angle, tolerance, !edge.runs_up, edge.index});
    }
    std::sort(spokes.begin(), spokes.end(),
              [](const Spoke& a, const Spoke& b) { return a.angle != b.angle ? a.angle < b.angle : a.index < b.index; });
    putEndsFirst(spokes);
    return spokes;
}

// Matches them like brackets around the circle. What has no counterpart stays without a mate.
void pairAroundEdge(const Mesh& mesh, std::span<const HalfEdge> around, double rounding, std::vector<uint32_t>& mates) {
    const std::vector<Spoke> spokes = sortedSpokes(mesh, around, rounding);
    std::vector<uint32_t> open;
    for (size_t k = 0; k < 2 * spokes.size(); ++k) { // the second turn closes what the first left open
        const Spoke& spoke = spokes[k % spokes.size()];
        if (mates[spoke.index] != kNoMate) continue;
        if (spoke.opens && k < spokes.size()) open.push_back(spoke.index);
        if (spoke.opens || open.empty()) continue;
        mates[spoke.index] = open.back();
        mates[open.back()] = spoke.index;
        open.pop_back();
    }
}

// Coordinates are floats about the center of the mesh, and come of a few operations.
double roundingOf(const Mesh& mesh) {
    float reach = 0;
    for (const Float3& p : mesh.positions)
        reach = std::max({reach, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return 0x1p-21 * double{reach};
}

void pair(const Mesh& mesh, std::span<const HalfEdge> around, double rounding, std::vector<uint32_t>& mates) {
    if (around.size() != 2) return pairAroundEdge(mesh, around, rounding, mates);
    if (around[0].runs_up == around[1].runs_up) return;
    mates[around[0].index] = around[1].index;
    mates[around[1].index] = around[0].index;
}

} // namespace

MeshTopology buildTopology(const Mesh& mesh) {
    const std::vector<HalfEdge> sorted = sortedHalfEdges(mesh);
    MeshTopology topology;
    topology.edges.reserve(sorted.size() / 2);
    topology.triangle_edges.resize(mesh.triangles.size());
    topology.half_edge_mates.assign(sorted.size(), kNoMate);
    const double rounding = roundingOf(mesh);
    for (size_t first = 0, last = 0; first < sorted.size(); first = last) {
        const auto edge = static_cast<uint32_t>(topology.edges.size());
        for (; last < sorted.size() && sorted[last].low == sorted[first].low && sorted[last].high == sorted[first].high; ++last)
            topology.triangle_edges[sorted[last].index / 3][sorted[last].index % 3] = edge;
        topology.edges.push_back({sorted[first].low, sorted[first].high});
        pair(mesh, std::span(sorted).subspan(first, last - first), rounding, topology.half_edge_mates);
    }
    return topology;
}

bool touchesItself(const MeshTopology& topology) { return 2 * topology.edges.size() < topology.half_edge_mates.size(); }

} // namespace brittle
