// Cuts polygons into triangles by clipping ears, so that concave ones come out right where a fan would not.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <span>

namespace brittle {

// Triangles of indices into the outline, which runs once around the polygon and need not be quite flat. A convex outline
// gives the fan from its first corner. Empty where the outline crosses itself and no triangulation exists, or finding one
// would take too long.
std::vector<Index3> triangulatePolygon(std::span<const Double3> outline);

} // namespace brittle
