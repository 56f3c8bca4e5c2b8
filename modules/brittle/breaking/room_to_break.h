// How much may break: in a world at a time, and in one step.
#pragma once

#include "modules/brittle/breaking/surface_places.h"
#include "modules/brittle/breaking/world_pools.h"
#include "modules/brittle/dynamics/world_contents.h"

namespace brittle {

// 0: chosen by what the contents are.
struct BreakingBudget {
    uint32_t fragments = 0;      // that there are at a time
    uint32_t faces = 0;          // of their hulls
    uint32_t triangles = 0;      // of their surfaces
    uint32_t step_bodies = 0;    // that break in a step, at most MOST_BREAKING; others wait
    uint32_t step_triangles = 0; // of their surfaces; a body with more never breaks
    uint32_t step_sites = 0;
    uint32_t most_fragments = 0; // of one body
    uint32_t particles = 0;      // of dust, that fly at a time, rounded up to a power of two
    uint32_t part_triangles = 0; // of the list of surfaces, that kernels take at once (surface_list.h)
};

struct RoomToBreak {
    uint32_t step_bodies = 0, step_triangles = 0, step_sites = 0, most_fragments = 0, particles = 0;
    uint32_t bodies = 0, pieces = 0;  // that there are before anything breaks
    uint32_t pairs = 0, contacts = 0; // that there may be; 0: as many as are needed
    uint32_t whole = 0;               // bodies that can break, before anything does
    uint32_t kept_for_each = 0;       // fragments, for each body of the scene that has not broken yet
    uint32_t kept_for_whole = 0;      // fragments, for all of them together, by fragments that break again
    bool radial = false;              // some body breaks in rays
    bool touching = false;            // some surface may touch itself
    SurfacePlaces surfaces;
    PoolRoom pools;
    FreeLists free; // before anything breaks
};

// Triangles of the largest surface that can break.
uint32_t largestSurface(const WorldContents& contents);

// Returns the numbers of RoomToBreak that begin with `step_`, and `most_fragments`. `largest_surface`: triangles of the largest
// body that breaks.
RoomToBreak roomInAStep(uint32_t largest_surface, const BreakingBudget& budget);

// Every number given. Errors: Capacity for more than pools can hold (world_pools.h).
engine::Result<RoomToBreak> roomToBreak(const WorldContents& contents, const BreakingBudget& budget);

// The contents with empty slots for all that there is room for: absent bodies and pieces, surfaces in their places, and hulls
// laid out as fragments' are, each in the slot of its piece. First vertices, edges and corners are multiples of the first face
// (shaders-spirv/shared/breaking.h).
WorldContents withRoom(const WorldContents& contents, const RoomToBreak& room);

} // namespace brittle
