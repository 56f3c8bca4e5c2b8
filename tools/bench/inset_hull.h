// Hulls that are drawn in, for engines that lay a margin around them.
#pragma once

#include "tools/bench/inputs.h"

#include <vector>

namespace bench {

struct HullPlane {
    Point normal = {0, 1, 0}; // outward, unit
    double height = 0;
};

// The corners of what lies behind all planes, by at least `depth`. `size`: of the hull, by which rounding is told from gaps.
std::vector<Point> insetCorners(const std::vector<HullPlane>& planes, double depth, double size);

} // namespace bench
