// Normals for corners that have none.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

// Replaces the zero normals: surfaces are smooth across edges that bend by less than 40 degrees and sharp across others; every
// triangle counts by its angle at the corner. Those that are there become of unit length.
void completeNormals(Mesh& mesh, const MeshTopology& topology);

} // namespace brittle
