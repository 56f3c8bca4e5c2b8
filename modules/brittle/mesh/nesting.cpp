#include "modules/brittle/mesh/nesting.h"

#include "modules/brittle/mesh/self_intersection.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <optional>

namespace brittle {
namespace {

struct Meeting {
    bool is_clear = true; // well inside or well outside the triangle
    double distance = -1; // along the ray, negative for none
    int turn = 0;
};

Meeting meet(const Corners& p, const Double3& origin, const Double3& direction) {
    constexpr double kMargin = 1e-7; // of the triangle: nearer to an edge the neighbor may be hit as well, or neither
    const Double3 normal = doubleArea(p);
    const double facing = dot(normal, direction);
    const Double3 to_plane = p[0] - origin;
    const double scale = dot(normal, normal);
    if (scale == 0) return {};
    if (std::abs(facing) < 1e-7 * std::sqrt(scale)) return {std::abs(dot(normal, to_plane)) > kMargin * scale, -1, 0};
    const double distance = dot(normal, to_plane) / facing;
    const Double3 at = origin + distance * direction;
    double least = HUGE_VAL;
    for (size_t k = 0; k < 3; ++k)
        least = std::min(least, dot(normal, cross(p[(k + 1) % 3] - p[k], at - p[k])) / scale);
    if (least < -kMargin || distance < 0) return {};
    return {least > kMargin, distance, facing > 0 ? 1 : -1};
}

double fraction(double x) { return x - std::floor(x); }

} // namespace

struct Nesting::Ray {
    uint32_t from = 0; // triangle
    Double3 origin, direction;
};

struct Nesting::Windings {
    bool is_touched = false; // a surface lies within the depth of a touch below the triangle
    int at_surface = 0;      // as the doubles have the order of the surfaces
    int below_touch = 0;     // where what touches counts as above
};

// Spread over the triangle, in odd directions.
Nesting::Ray Nesting::rayBelow(uint32_t triangle, int attempt) const {
    const Corners p = cornersOf(mesh_, triangle);
    const Double3 normal = normalized(doubleArea(p), {0, 0, 1});
    double u = fraction(0.31 + 0.7549 * attempt), v = fraction(0.37 + 0.5698 * attempt);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const double tilt = 0.071 + 0.037 * attempt;
    const Double3 along = normalized(p[1] - p[0], {1, 0, 0}), across = cross(normal, along);
    return {triangle, p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]),
            normalized(tilt * along + (0.7 * tilt) * across - normal, {0, 0, -1})};
}

// False where the ray grazes an edge: it tells nothing then.
bool Nesting::collectHits(const Ray& ray) {
    bool is_clear = true;
    hits_.clear();
    tree_.forEachAlong(ray.origin, ray.direction, [&](uint32_t t) {
        ++tests_;
        if (t == ray.from) return;
        const Meeting found = meet(cornersOf(mesh_, t), ray.origin, ray.direction);
        is_clear = is_clear && found.is_clear;
        if (found.distance >= 0) hits_.push_back({found.distance, found.turn, components_.of[t] == components_.of[ray.from]});
    });
    return is_clear;
}

Nesting::Windings Nesting::windings() const {
    const double touch = kTouchDepth * diagonal_, noise = kNoiseDepth * diagonal_;
    double half_way = HUGE_VAL; // through the component's own solid
    for (const Hit& hit : hits_)
        if (hit.is_own && hit.distance > noise) half_way = std::min(half_way, 0.5 * hit.distance);
    Windings windings;
    for (const Hit& hit : hits_) {
        windings.is_touched = windings.is_touched || hit.distance < touch;
        if (hit.distance >= noise) windings.at_surface += hit.turn;
        if (hit.distance >= std::min(touch, half_way)) windings.below_touch += hit.turn;
    }
    return windings;
}

// The wall of a hollow in a shell thinner than a touch has the shell's other side that near all over. Such a wall is right if
// it is right by the order of the surfaces, everywhere.
int Nesting::windingBelow(uint32_t component) {
    constexpr int kAttempts = 4; // for each triangle
    std::optional<int> below_touch;
    bool is_right_at_surface = true;
    for (const uint32_t triangle : components_.all[component].facing) {
        if (triangle == kNoTriangle) continue;
        for (int attempt = 0; attempt < kAttempts; ++attempt) {
            if (!collectHits(rayBelow(triangle, attempt))) continue;
            const Windings found = windings();
            if (!found.is_touched) return found.at_surface;
            is_right_at_surface = is_right_at_surface && found.at_surface == 1;
            if (!below_touch || found.below_touch != 1) below_touch = found.below_touch;
        }
    }
    return is_right_at_surface ? 1 : below_touch.value_or(1);
}

} // namespace brittle
