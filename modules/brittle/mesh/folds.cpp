#include "modules/brittle/mesh/folds.h"

#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

namespace brittle {
namespace {

constexpr double kMostAngle = 1e-3; // between the triangles
constexpr double kLeastHeight = 10; // touches; what is lower is a sliver

// The way from the edge to the third corner, across the edge.
Double3 heightOver(const Corners& p, size_t edge) {
    const Double3 side = p[(edge + 1) % 3] - p[edge], arm = p[(edge + 2) % 3] - p[edge];
    const double squared = dot(side, side);
    return squared > 0 ? arm - (dot(arm, side) / squared) * side : Double3{0, 0, 0};
}

bool liesOn(const Double3& a, const Double3& b, double touch) {
    const double lower = std::min(length(a), length(b)), higher = std::max(length(a), length(b));
    if (lower < kLeastHeight * touch || dot(a, b) <= 0) return false;
    return length(cross(a, b)) <= std::min(touch, kMostAngle * lower) * higher;
}

} // namespace

std::vector<uint32_t> findFolds(const Mesh& mesh, const MeshTopology& topology, double touch) {
    std::vector<uint32_t> folds;
    for (uint32_t h = 0; h < topology.half_edge_mates.size(); ++h) {
        const uint32_t mate = topology.half_edge_mates[h];
        if (mate == kNoMate || mate < h) continue;
        const Double3 here = heightOver(cornersOf(mesh, h / 3), h % 3), there = heightOver(cornersOf(mesh, mate / 3), mate % 3);
        if (liesOn(here, there, touch)) folds.push_back(topology.triangle_edges[h / 3][h % 3]);
    }
    return folds;
}

} // namespace brittle
