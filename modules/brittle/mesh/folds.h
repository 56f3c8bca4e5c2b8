// Edges at which a face folds back and lies on its neighbor, as in a polygon that is not convex and was cut into triangles from
// one corner. Such a surface encloses the right volume, and is there twice.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

// Returns the edges. `touch`: the distance within which triangles lie on each other, in model units.
std::vector<uint32_t> findFolds(const Mesh& mesh, const MeshTopology& topology, double touch);

} // namespace brittle
