#include "modules/brittle/mesh/self_intersection.h"

#include <algorithm>

namespace brittle {
namespace {

// Overlap of the triangles' shadows on the axis; infinite on an axis that is no direction.
double overlapAlong(const Double3& axis, const Corners& a, const Corners& b, double min_squared) {
    const double squared = dot(axis, axis);
    if (squared <= min_squared) return HUGE_VAL;
    const auto [a_low, a_high] = std::minmax({dot(axis, a[0]), dot(axis, a[1]), dot(axis, a[2])});
    const auto [b_low, b_high] = std::minmax({dot(axis, b[0]), dot(axis, b[1]), dot(axis, b[2])});
    return std::min(a_high - b_low, b_high - a_low) / std::sqrt(squared);
}

std::array<Double3, 3> edgesOf(const Corners& p) { return {p[1] - p[0], p[2] - p[1], p[0] - p[2]}; }

uint32_t sharedCorners(const Index3& a, const Index3& b) {
    uint32_t shared = 0;
    for (const uint32_t v : a)
        shared += v == b[0] || v == b[1] || v == b[2] ? 1 : 0;
    return shared;
}

} // namespace

double penetrationDepth(const Corners& a, const Corners& b, double floor) {
    // Near the origin products keep their digits.
    const Corners p = {Double3{0, 0, 0}, a[1] - a[0], a[2] - a[0]}, q = {b[0] - a[0], b[1] - a[0], b[2] - a[0]};
    const std::array<Double3, 3> e = edgesOf(p), f = edgesOf(q);
    // Products of edges that are parallel but for rounding point anywhere.
    const auto longest = [](const std::array<Double3, 3>& edges) {
        return std::max({dot(edges[0], edges[0]), dot(edges[1], edges[1]), dot(edges[2], edges[2])});
    };
    const double e2 = longest(e), f2 = longest(f), negligible = 1e-28;
    double depth = overlapAlong(cross(e[0], e[1]), p, q, negligible * e2 * e2);
    if (depth <= floor) return 0;
    depth = std::min(depth, overlapAlong(cross(f[0], f[1]), p, q, negligible * f2 * f2));
    for (const Double3& edge : e)
        for (const Double3& other : f) {
            if (depth <= floor) return 0;
            depth = std::min(depth, overlapAlong(cross(edge, other), p, q, negligible * dot(edge, edge) * dot(other, other)));
        }
    return depth <= floor || depth == HUGE_VAL ? 0 : depth;
}

SelfIntersection findSelfIntersections(const Mesh& mesh, const TriangleTree& tree, double diagonal) {
    SelfIntersection found;
    uint64_t tests = 0;
    tree.forEachPair([&](uint32_t s, uint32_t t) {
        found.gave_up = ++tests > kMaxPairTests;
        // Neighbors across an edge have their hinge in common; however they fold, they do not pass through each other.
        if (sharedCorners(mesh.triangles[s], mesh.triangles[t]) >= 2) return !found.gave_up;
        const Corners a = cornersOf(mesh, s), b = cornersOf(mesh, t);
        const double depth = penetrationDepth(a, b, kNoiseDepth * diagonal);
        if (depth == 0) return !found.gave_up;
        const Crossing crossing{s, t, depth, 0.5 * (middleOf(a) + middleOf(b))};
        if (depth > found.deepest.depth) found.deepest = crossing;
        if (depth < kTouchDepth * diagonal)
            ++found.touching_pairs;
        else
            found.crossings.push_back(crossing);
        return found.crossings.size() < kMaxCrossings && !found.gave_up;
    });
    found.crossing_pairs = static_cast<uint32_t>(found.crossings.size());
    return found;
}

} // namespace brittle
