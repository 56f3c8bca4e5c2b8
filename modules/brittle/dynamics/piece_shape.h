// Pieces of bodies from convex hulls and from what a fracture makes, about a center of mass.
#pragma once

#include "modules/brittle/collision/collider.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/scene/hull/convex_hull.h"

namespace brittle {

PieceShape pieceOf(const ConvexHull& hull, const Double3& center);
// `center` counts, as the vertices do, from the middle of what was broken.
PieceShape pieceOf(const ColliderSet& set, const ColliderPiece& piece, const Double3& center);

} // namespace brittle
