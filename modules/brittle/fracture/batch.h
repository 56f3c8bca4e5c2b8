// Several objects that break at the same time are one event: one recording, one run of every kernel, whatever their number.
//
// Each keeps a grid of its own. The grids stand in tiles of one space (shaders-spirv/lib/tile.glsl), so that places of
// different objects are never the same and never near; all that decides goes by ways within a tile. Objects of any size go
// together, for each is scaled by a power of two to the size of its grid, which rounds nothing, and scaled back when it is
// read.
#pragma once

#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/fracture/pools.h"

#include <span>
#include <vector>

namespace brittle {

struct Batch {
    Mesh mesh; // of all objects, each about its own center, in units of half its grid's edge
    MeshTopology topology;
    EventGrid grid;
    Capacities capacity;
    std::vector<Int3> sites;            // on the grid, in their tiles
    std::vector<uint32_t> vertex_tiles; // of each vertex, the number of its object
    struct Object {
        Double3 center = {0, 0, 0};
        double unit = 1; // model units in a unit of `mesh`
        uint32_t first_site = 0, site_count = 0;
    };
    std::vector<Object> objects;
};

// Errors, with the number of the object, counted from 1: those of makeEventGrid, BadInput for one without sites or triangles,
// or where there are more than kMostObjects.
constexpr uint32_t kMostObjects = 256;
engine::Result<Batch> joinObjects(std::span<const BreakingObject> objects);

// What became of each object, from what became of all. Times and counts of the whole stand with the first.
std::vector<FractureResult> partResult(const Batch& batch, const FractureResult& all,
                                       const std::vector<uint32_t>& site_objects);

} // namespace brittle
