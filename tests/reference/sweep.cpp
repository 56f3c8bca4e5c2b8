#include "tests/reference/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reference {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Interval {
    double first = -kNever, last = kNever;
};

std::array<double, 2> shadowOf(const Convex& solid, const Point& axis) {
    std::array<double, 2> shadow = {kNever, -kNever};
    for (const Point& p : solid.vertices) {
        shadow[0] = std::min(shadow[0], dot(axis, p));
        shadow[1] = std::max(shadow[1], dot(axis, p));
    }
    return shadow;
}

// When the shadows overlap while b's moves.
Interval overlapOn(const Convex& a, const Convex& b, const Point& axis, const Point& motion) {
    const auto [a_low, a_high] = shadowOf(a, axis);
    const auto [b_low, b_high] = shadowOf(b, axis);
    const double speed = dot(axis, motion);
    if (std::abs(speed) < 1e-14 * length(motion) || length(motion) == 0)
        return b_low > a_high || a_low > b_high ? Interval{kNever, -kNever} : Interval{};
    const double one = (a_high - b_low) / speed, other = (a_low - b_high) / speed;
    return {std::min(one, other), std::max(one, other)};
}

std::vector<Point> edgesOf(const Convex& solid) {
    std::vector<Point> edges;
    for (const ConvexFace& face : solid.faces)
        for (size_t k = 0; k < face.loop.size(); ++k) {
            const uint32_t from = face.loop[k], to = face.loop[(k + 1) % face.loop.size()];
            if (from < to) edges.push_back(solid.vertices[to] - solid.vertices[from]);
        }
    return edges;
}

void addCross(std::vector<Point>& axes, const Point& u, const Point& w) {
    const Point axis = cross(u, w);
    const double size = length(axis);
    if (size > 1e-7 * length(u) * length(w) && size > 0) axes.push_back((1 / size) * axis);
}

std::vector<Point> axesOf(const Convex& a, const Convex& b) {
    std::vector<Point> axes;
    for (const Convex* solid : {&a, &b})
        for (const ConvexFace& face : solid->faces)
            axes.push_back(face.normal);
    for (const Point& u : edgesOf(a))
        for (const Point& w : edgesOf(b))
            addCross(axes, u, w);
    return axes;
}

} // namespace

double impactOf(const Convex& a, const Convex& b, const Point& motion) {
    Interval all;
    for (const Point& axis : axesOf(a, b)) {
        const Interval on = overlapOn(a, b, axis, motion);
        all = {std::max(all.first, on.first), std::min(all.last, on.last)};
        if (all.first > all.last || all.last < 0 || all.first > 1) return kNever;
    }
    return std::max(all.first, 0.0);
}

} // namespace reference
