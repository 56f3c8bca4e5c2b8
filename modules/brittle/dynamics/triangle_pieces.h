// The pieces of a surface that does not move: its triangles, and which of their sides are hidden.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <vector>

namespace brittle {

// Every triangle is a piece of its own, with two sides. One that has collapsed to a line is left out. A side is hidden where
// another triangle of the surface goes on behind it, at an angle of at most five degrees; corners count as one if their places
// are the same.
std::vector<PieceShape> trianglePieces(const ImportedMesh& surface);

} // namespace brittle
