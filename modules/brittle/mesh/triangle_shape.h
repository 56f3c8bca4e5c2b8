// Where a triangle of a mesh is and what it looks like.
#pragma once

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>

namespace brittle {

using Corners = std::array<Double3, 3>;

// Relative to the mesh's center, as are all places here.
inline Corners cornersOf(const Mesh& mesh, const Index3& t) {
    return {toDouble(mesh.positions[t[0]]), toDouble(mesh.positions[t[1]]), toDouble(mesh.positions[t[2]])};
}
inline Corners cornersOf(const Mesh& mesh, size_t triangle) { return cornersOf(mesh, mesh.triangles[triangle]); }

inline Double3 doubleArea(const Corners& p) { return cross(p[1] - p[0], p[2] - p[0]); }
inline Double3 middleOf(const Corners& p) { return (1.0 / 3) * (p[0] + p[1] + p[2]); }

// The square of the longest side.
inline double longestSquared(const Corners& p) {
    const Double3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
    return std::max({dot(a, a), dot(b, b), dot(c, c)});
}

// Longest side by the height above it: 1.15 for the equilateral, infinite for one without area.
inline double aspectOf(const Corners& p) {
    const double area = length(doubleArea(p));
    return area > 0 ? longestSquared(p) / area : HUGE_VAL;
}

constexpr double kFlatAspect = 1e12; // flatter than this is no area but rounding
inline bool isFlat(const Corners& p) { return aspectOf(p) >= kFlatAspect; }

inline Double3 middleOfEdge(const Mesh& mesh, uint32_t a, uint32_t b) {
    return 0.5 * (toDouble(mesh.positions[a]) + toDouble(mesh.positions[b]));
}

} // namespace brittle
