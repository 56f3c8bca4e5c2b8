#include "tests/support/inset_hull.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace support {
namespace {

using brittle::operator+, brittle::operator-, brittle::operator*;
using brittle::cross, brittle::dot;
using reference::Point;

constexpr double kRounding = 1e-6; // of the size: hulls are of floats
constexpr double kParallel = 1e-6; // a volume of three normals below which their planes have no common point

struct Plane {
    Point normal = {0, 1, 0};
    double height = 0;
};

std::optional<Point> commonPoint(const Plane& a, const Plane& b, const Plane& c) {
    const Point across = cross(b.normal, c.normal);
    const double volume = dot(a.normal, across);
    if (std::fabs(volume) < kParallel) return std::nullopt;
    return (1 / volume) * (a.height * across + b.height * cross(c.normal, a.normal) + c.height * cross(a.normal, b.normal));
}

bool liesBehind(const std::vector<Plane>& planes, const Point& p, double rounding) {
    return std::ranges::all_of(planes, [&](const Plane& f) { return dot(f.normal, p) <= f.height + rounding; });
}

void addCorner(std::vector<Point>& corners, const Point& p, double rounding) {
    const bool is_known = std::ranges::any_of(corners, [&](const Point& q) { return brittle::length(p - q) <= rounding; });
    if (!is_known) corners.push_back(p);
}

} // namespace

std::vector<Point> insetCorners(const reference::Convex& solid, double depth) {
    std::vector<Plane> planes;
    for (const reference::ConvexFace& face : solid.faces)
        planes.push_back({face.normal, face.height - depth});
    double size = 0;
    for (const Point& v : solid.vertices)
        size = std::max(size, brittle::length(v - solid.vertices.front()));
    std::vector<Point> corners;
    for (size_t a = 0; a < planes.size(); ++a)
        for (size_t b = a + 1; b < planes.size(); ++b)
            for (size_t c = b + 1; c < planes.size(); ++c) {
                const auto p = commonPoint(planes[a], planes[b], planes[c]);
                if (p && liesBehind(planes, *p, kRounding * size)) addCorner(corners, *p, 10 * kRounding * size);
            }
    return corners;
}

} // namespace support
