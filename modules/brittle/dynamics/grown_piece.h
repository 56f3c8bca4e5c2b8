// A piece of a fracture that is larger on all sides, so that it overlaps its neighbors.
#pragma once

#include "modules/brittle/collision/collider.h"
#include "modules/brittle/dynamics/world_contents.h"

namespace brittle {

// About `center`, from the middle of what was broken. Every face is moved outward by `grow`, in the unit of the pieces. Errors:
// what the hull of its points fails with (scene/hull/convex_hull.h).
engine::Result<PieceShape> grownPiece(const ColliderSet& set, const ColliderPiece& piece, const Double3& center, double grow);

} // namespace brittle
