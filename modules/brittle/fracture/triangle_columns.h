// Triangles by the columns of an (x, y) raster; the inside test looks along z in one of them, and sites are drawn in them.
#pragma once

#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace brittle {

struct TriangleColumns {
    int32_t edge = 1; // of a column, grid steps
    int32_t per_row = 1;
    std::vector<uint32_t> start;     // first entry of each column, and the end
    std::vector<uint32_t> triangles; // every column has those that lie over it, and maybe some that come near
    std::vector<Int4> occupied;      // x and y index, lowest and highest z of its triangles
    uint32_t tallest = 0;            // the most that lies between the two
};

// As many columns as triangles, about. Fewer where long triangles would stand in the lists of too many; more where columns
// would hold little of the solid between their lowest and highest triangles, as those of a thin plate at an angle do, and
// finer ones hold less of the rest: nearly all that is drawn in them would be rejected.
TriangleColumns makeColumns(const Mesh& mesh, const EventGrid& grid);

} // namespace brittle
