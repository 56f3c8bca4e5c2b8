// Where a surface ends: its open edges, strung together into the rims of holes.
#pragma once

#include "modules/brittle/mesh/half_edge.h"

namespace brittle {

struct BoundaryLoop {
    std::vector<uint32_t> half_edges; // each ends, in its triangle, where the next starts; or starts where the next ends
    bool is_simple = false;           // comes back to its start and passes no vertex twice: the rim of one hole
};

struct Boundary {
    std::vector<BoundaryLoop> loops; // every open edge is in one
    // Of every half-edge of the loops, in their order: which rim it lies on when sheets that meet in a vertex only are
    // pulled apart there. That is the count of rims for Euler's formula; loops are what one would close.
    std::vector<uint32_t> rims;
};

// Two sheets that meet in a vertex make one corner each for two holes there, so a loop passes from one sheet to the other.
// Where more meet, or edges of more than two triangles end a sheet, no order is certain and loops are not simple.
Boundary findBoundary(const Mesh& mesh, const EdgeUses& uses);

} // namespace brittle
