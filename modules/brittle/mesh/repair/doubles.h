// Triangles that are there more than once.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

// Of triangles with the same three corners, whichever way they face, one is kept, with two exceptions. Where a patch of them
// ends at edges that other triangles meet in pairs, it is the wall between two solids that touch: all of it goes, and they
// become one. Where neither fits all around a patch, or it is a sheet with air on both sides, nothing is done.
// Returns where triangles were dropped, relative to the mesh's center.
std::vector<Double3> dropDoubles(Mesh& mesh);

} // namespace brittle
