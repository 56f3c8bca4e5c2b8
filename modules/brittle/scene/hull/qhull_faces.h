// Qhull, asked for one thing: the faces of the hull of clean points.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/hull/hull_points.h"

namespace brittle {

struct PointFace {
    Double3 normal = {0, 0, 0}; // about outward; not yet exact
    std::vector<uint32_t> loop; // points, once around the face, either way
};

// Neighbors are one face already where the middle of one lies within `flatness`, in parts of the points' size, of the other's
// plane. Errors: Internal (Qhull gave up), with what it said.
engine::Result<std::vector<PointFace>> facesOfHull(const CleanPoints& clean, double flatness);

} // namespace brittle
