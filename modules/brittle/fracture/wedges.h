// Wedges of solid at edges where a surface touches itself, as the grid of an event has them.
#pragma once

#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/mesh/topology.h"

namespace brittle {

// Returns for every half-edge at an edge of more than two triangles its wedge: the lower of the two half-edges that bound it.
// Other half-edges get kNoMate. Vertices of one place on the grid are one vertex. Empty if the surface touches itself nowhere.
std::vector<uint32_t> wedgesOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid);

} // namespace brittle
