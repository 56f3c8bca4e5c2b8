// The first thing that becomes of objects that break: from their surfaces, as they are drawn, to the mesh that fracture takes,
// all on the device. Which objects, and so how many corners there are, the host does not know.
#pragma once

#include "engine/arena.h"
#include "modules/brittle/breaking/surface_list.h"
#include "modules/brittle/fracture/recorder.h"
#include "shaders-spirv/shared/breaking.h"

namespace brittle {

// The most that may break at once.
struct GatherRoom {
    uint32_t objects = 0;
    uint32_t triangles = 0;
    uint32_t corners() const { return 3 * triangles; }
    // Of a closed surface: half as many as triangles, and a few more where surfaces touch themselves.
    uint32_t vertices = 0;
    uint32_t edges = 0;
};

// A closed surface of so many triangles has about half as many vertices, and half as many edges again as triangles; where it
// has been rounded until it touches itself there may be more vertices.
GatherRoom roomFor(uint32_t objects, uint32_t triangles);

// Scratch memory, and the mesh: triangles of surfaces first, then those of faces of earlier cuts.
struct GatherBuffers {
    engine::BufferView corners, table, slots, firsts, flags, vertex_numbers, triangle_flags, triangle_numbers, sides,
        edge_numbers, sums;
    engine::BufferView mesh_positions, grid_vertices, mesh_triangles, corner_attributes, triangle_edges, mesh_edges;
};
GatherBuffers layOutGather(engine::ScratchArena& arena, const GatherRoom& room);
// Without the mesh, whose buffers are another's.
void takeGatherScratch(engine::ScratchArena& arena, const GatherRoom& room, GatherBuffers& b);

// Wants COUNT_BREAKING, COUNT_SOUP_TRIANGLES and COUNT_SOUP_CORNERS published; publishes COUNT_MESH_VERTICES,
// COUNT_OWN_TRIANGLES, COUNT_EARLIER_TRIANGLES, COUNT_MESH_TRIANGLES, COUNT_MESH_CORNERS and COUNT_MESH_EDGES. `breaking`:
// BreakingRecords in order. What does not fit fails the event, as everywhere.
void recordGather(Recorder& record, const GatherRoom& room, const GatherBuffers& b, engine::BufferView breaking,
                  const SurfaceList& surfaces);

// After that: `raw_sites`, three words each on the grids of their objects in their tiles, and `placed`, a word each, 0 for a
// site that found no place. Wants COUNT_ASKED_SITES published. How they lie is said by their object's SITES_*.
void recordBreakingSites(Recorder& record, const GatherBuffers& b, engine::BufferView breaking, engine::BufferView raw_sites,
                         engine::BufferView placed);

} // namespace brittle
