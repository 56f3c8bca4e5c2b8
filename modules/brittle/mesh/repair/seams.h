// Seams: open edges that lie against each other but are not one, because their vertices differ by rounding or because one side
// was split and the other was not.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

// All of these return where something was done, relative to the mesh's center. Positions never move but onto each other's.

// Joins vertices of open edges that are one but for rounding: the clusters within kSeamWidth, if all others are four times as
// far away and no triangle would collapse. Everything goes to the lowest vertex.
std::vector<Double3> joinSeams(Mesh& mesh, double diagonal);

// Drops triangles without area whose edges do not pair up, until there are none.
std::vector<Double3> dropLooseFlat(Mesh& mesh);

// Splits triangles at vertices of other open edges that lie on an open edge of theirs, to within kJunctionWidth.
std::vector<Double3> splitJunctions(Mesh& mesh, double diagonal);

} // namespace brittle
