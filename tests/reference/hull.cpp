#include "tests/reference/hull.h"

#include <algorithm>
#include <cmath>

namespace reference {
namespace {

bool holdsAll(std::span<const Point> points, const Point& normal, double height, double flat) {
    return std::all_of(points.begin(), points.end(), [&](const Point& p) { return dot(normal, p) - height <= flat; });
}

bool isKnown(const Convex& hull, const Point& normal, double height, double flat) {
    return std::any_of(hull.faces.begin(), hull.faces.end(), [&](const ConvexFace& face) {
        return length(face.normal - normal) < 1e-4 && std::fabs(face.height - height) <= 4 * flat;
    });
}

// The points in the plane, by their angle about their middle.
std::vector<uint32_t> loopIn(std::span<const Point> points, const Point& normal, double height, double flat) {
    std::vector<uint32_t> loop;
    Point middle = {0, 0, 0};
    for (uint32_t v = 0; v < points.size(); ++v)
        if (std::fabs(dot(normal, points[v]) - height) <= 2 * flat) {
            loop.push_back(v);
            middle = middle + points[v];
        }
    middle = 1.0 / static_cast<double>(loop.size()) * middle;
    const Point x = points[loop[0]] - middle, y = cross(normal, x);
    const auto angle = [&](uint32_t v) { return std::atan2(dot(points[v] - middle, y), dot(points[v] - middle, x)); };
    std::sort(loop.begin(), loop.end(), [&](uint32_t a, uint32_t b) { return angle(a) < angle(b); });
    return loop;
}

} // namespace

Convex hullByBruteForce(std::span<const Point> points, double flat) {
    Convex hull;
    hull.vertices.assign(points.begin(), points.end());
    for (const Point& a : points)
        for (const Point& b : points)
            for (const Point& c : points) {
                const Point area = cross(b - a, c - a);
                const double size = length(area);
                if (size < 1e-9) continue;
                const Point normal = (1 / size) * area;
                const double height = dot(normal, a);
                if (!holdsAll(points, normal, height, flat) || isKnown(hull, normal, height, flat)) continue;
                hull.faces.push_back({normal, height, loopIn(points, normal, height, flat)});
            }
    return hull;
}

Weight weightOf(const Convex& solid) {
    struct Sample {
        Point place;
        double volume;
    };
    std::vector<Sample> samples;
    const Point top = solid.vertices[solid.faces[0].loop[0]];
    const double far = (5 + 3 * std::sqrt(5.0)) / 20, near = (5 - std::sqrt(5.0)) / 20;
    for (const ConvexFace& face : solid.faces)
        for (size_t k = 1; k + 1 < face.loop.size(); ++k) {
            const std::array<Point, 4> t = {top, solid.vertices[face.loop[0]], solid.vertices[face.loop[k]],
                                            solid.vertices[face.loop[k + 1]]};
            const double volume = dot(t[1] - top, cross(t[2] - top, t[3] - top)) / 6;
            const Point all = t[0] + t[1] + t[2] + t[3];
            for (const Point& corner : t)
                samples.push_back({near * all + (far - near) * corner, volume / 4});
        }
    Weight weight;
    for (const Sample& s : samples) {
        weight.volume += s.volume;
        weight.center = weight.center + s.volume * s.place;
    }
    weight.center = (1 / weight.volume) * weight.center;
    for (const auto& [place, volume] : samples) {
        const Point r = place - weight.center;
        for (size_t i = 0; i < 3; ++i)
            weight.inertia[i] += volume * (dot(r, r) - r[i] * r[i]);
        weight.inertia[3] -= volume * r[0] * r[1];
        weight.inertia[4] -= volume * r[0] * r[2];
        weight.inertia[5] -= volume * r[1] * r[2];
    }
    return weight;
}

} // namespace reference
