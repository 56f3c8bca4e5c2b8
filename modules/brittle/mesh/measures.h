// Volume, area and centroid of a closed mesh, by the divergence theorem in double.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

MeshMeasures measureMesh(const Mesh& mesh);

} // namespace brittle
