#include "tests/reference/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reference {

double length(const Point& a) { return std::sqrt(dot(a, a)); }

void Bounds::grow(const Point& p) {
    for (size_t k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], p[k]);
        upper[k] = std::max(upper[k], p[k]);
    }
}

bool Bounds::holds(const Point& p, double margin) const {
    for (size_t k = 0; k < 3; ++k)
        if (p[k] < lower[k] - margin || p[k] > upper[k] + margin) return false;
    return true;
}

Bounds boundsOf(std::span<const Triangle> triangles) {
    Bounds bounds;
    for (const Triangle& t : triangles)
        for (const Point& p : t)
            bounds.grow(p);
    return bounds;
}

double volumeOf(std::span<const Triangle> triangles) {
    const Point origin = boundsOf(triangles).center();
    double six_volumes = 0;
    for (const Triangle& t : triangles)
        six_volumes += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin));
    return six_volumes / 6;
}

double areaOf(std::span<const Triangle> triangles) {
    double area = 0;
    for (const Triangle& t : triangles)
        area += length(cross(t[1] - t[0], t[2] - t[0])) / 2;
    return area;
}

Point centroidOf(std::span<const Triangle> triangles) {
    const Point origin = boundsOf(triangles).center();
    Point moment = {0, 0, 0};
    double six_volumes = 0;
    for (const Triangle& t : triangles) {
        const Point a = t[0] - origin, b = t[1] - origin, c = t[2] - origin;
        const double six_volume = dot(a, cross(b, c)); // of the tetrahedron with the origin, whose centroid is (a + b + c) / 4
        moment = moment + six_volume / 4 * (a + b + c);
        six_volumes += six_volume;
    }
    return origin + 1 / six_volumes * moment;
}

// The solid angle of a triangle after van Oosterom and Strackee (1983).
long double windingNumber(std::span<const Triangle> triangles, const Point& p) {
    long double half_angles = 0;
    for (const Triangle& t : triangles) {
        const Point a = t[0] - p, b = t[1] - p, c = t[2] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        const double det = dot(a, cross(b, c));
        half_angles += std::atan2(det, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return half_angles / (2 * std::numbers::pi_v<long double>);
}

uint32_t nearestSite(std::span<const GridPoint> sites, const GridPoint& p) {
    const auto squared = [&](const GridPoint& site) {
        int64_t sum = 0;
        for (size_t k = 0; k < 3; ++k)
            sum += (int64_t(site[k]) - p[k]) * (int64_t(site[k]) - p[k]);
        return sum;
    };
    const auto nearest = std::min_element(sites.begin(), sites.end(),
                                          [&](const GridPoint& a, const GridPoint& b) { return squared(a) < squared(b); });
    return static_cast<uint32_t>(nearest - sites.begin());
}

uint32_t nearestSite(std::span<const Point> sites, const Point& p) {
    const auto nearest = std::min_element(
        sites.begin(), sites.end(), [&](const Point& a, const Point& b) { return dot(a - p, a - p) < dot(b - p, b - p); });
    return static_cast<uint32_t>(nearest - sites.begin());
}

double distanceOutsideCell(std::span<const Point> sites, uint32_t own, const Point& p) {
    const Point to_own = p - sites[own];
    double furthest = 0;
    for (size_t k = 0; k < sites.size(); ++k) {
        const Point across = sites[k] - sites[own];
        const double squared = dot(across, across);
        if (squared > 0) furthest = std::max(furthest, (dot(to_own, across) - squared / 2) / std::sqrt(squared));
    }
    return furthest;
}

} // namespace reference
