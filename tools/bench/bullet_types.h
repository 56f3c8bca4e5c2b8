// Bullet's vectors and ours. Only for files of a build that has Bullet.
#pragma once

#include "tools/bench/inputs.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace bench {

inline btVector3 vectorOf(const Point& p) {
    return {static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2])};
}

inline Point pointOf(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btTransform transformOf(const Point& place, const std::array<double, 4>& turn) {
    return btTransform(btQuaternion(static_cast<btScalar>(turn[0]), static_cast<btScalar>(turn[1]),
                                    static_cast<btScalar>(turn[2]), static_cast<btScalar>(turn[3])),
                       vectorOf(place));
}

// The half extents of corners that are those of a box about the body's center, along its axes, but for `rounding` of its size.
inline std::optional<btVector3> halfOf(const std::vector<Point>& corners, double rounding = 0) {
    Point half = {0, 0, 0};
    for (const Point& p : corners)
        for (size_t k = 0; k < 3; ++k)
            half[k] = std::max(half[k], std::fabs(p[k]));
    const double most = rounding * std::max({half[0], half[1], half[2]});
    const bool is_box =
        corners.size() == 8 && std::ranges::all_of(corners, [&](const Point& p) {
            return half[0] - std::fabs(p[0]) <= most && half[1] - std::fabs(p[1]) <= most && half[2] - std::fabs(p[2]) <= most;
        });
    return is_box ? std::optional(vectorOf(half)) : std::nullopt;
}

} // namespace bench
