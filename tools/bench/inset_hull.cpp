#include "tools/bench/inset_hull.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bench {
namespace {

using brittle::operator+, brittle::operator-, brittle::operator*;
using brittle::cross, brittle::dot;

constexpr double kRounding = 1e-6; // of the size: hulls are of floats
constexpr double kParallel = 1e-6; // a volume of three normals below which their planes have no common point

std::optional<Point> commonPoint(const HullPlane& a, const HullPlane& b, const HullPlane& c) {
    const Point bc = cross(b.normal, c.normal);
    const double volume = dot(a.normal, bc);
    if (std::fabs(volume) < kParallel) return std::nullopt;
    return (1 / volume) * (a.height * bc + b.height * cross(c.normal, a.normal) + c.height * cross(a.normal, b.normal));
}

bool liesBehind(const std::vector<HullPlane>& planes, const Point& p, double rounding) {
    return std::ranges::all_of(planes, [&](const HullPlane& f) { return dot(f.normal, p) <= f.height + rounding; });
}

void addCorner(std::vector<Point>& corners, const Point& p, double rounding) {
    const bool is_known = std::ranges::any_of(corners, [&](const Point& q) { return brittle::length(p - q) <= rounding; });
    if (!is_known) corners.push_back(p);
}

} // namespace

std::vector<Point> insetCorners(const std::vector<HullPlane>& planes, double depth, double size) {
    std::vector<HullPlane> inner = planes;
    for (HullPlane& plane : inner)
        plane.height -= depth;
    std::vector<Point> corners;
    for (size_t a = 0; a < inner.size(); ++a)
        for (size_t b = a + 1; b < inner.size(); ++b)
            for (size_t c = b + 1; c < inner.size(); ++c) {
                const auto p = commonPoint(inner[a], inner[b], inner[c]);
                if (p && liesBehind(inner, *p, kRounding * size)) addCorner(corners, *p, 10 * kRounding * size);
            }
    return corners;
}

} // namespace bench
