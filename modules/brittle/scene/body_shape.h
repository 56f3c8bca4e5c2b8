// The hulls of shapes that have one, and the mass of bodies that are one.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/hull/convex_hull.h"
#include "modules/brittle/scene/scene_description.h"

#include <optional>

namespace brittle {

// Points evenly spread over a sphere about the origin, along a spiral (Vogel 1979), at least 4. Meters.
std::vector<Double3> ballPoints(double radius, uint32_t count);

// The hull of a box, a ball, or a hull by its points; in the shape's own frame, meters. A hull by a file's vertices is read,
// from `folder` if its path is relative. Errors: BadInput, for points that span no solid, a file that cannot be read, and for
// shapes that have no hull (meshes, planes).
engine::Result<PointHull> hullOf(const ShapeDescription& shape, const std::filesystem::path& folder);

// kg: the mass given, or density times volume. `density` is what densityOf says (scene/scene_material.h).
double massOf(const BodyDescription& body, double density, double volume);

} // namespace brittle
