// Points made fit for a hull, or refused.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <span>
#include <vector>

namespace brittle {

struct CleanPoints {
    std::vector<Double3> points; // distinct, in the order given
    uint32_t joined = 0;
    Double3 middle = {0, 0, 0}; // of the box
    double size = 0;            // diagonal of the box
};

// Errors: as hullOfPoints (hull/convex_hull.h).
engine::Result<CleanPoints> cleanPoints(std::span<const Double3> points);

} // namespace brittle
