// What breaks in a step, from the surfaces that are drawn to fragments in the scene's pools, by one recording: the host knows
// how much may break, never what does. Where nothing breaks every dispatch over a count has no workgroups.
#pragma once

#include "modules/brittle/breaking/gather.h"
#include "modules/brittle/fracture/event.h"

namespace brittle {

// The most that may break at once.
struct BreakingRoom {
    GatherRoom mesh;
    uint32_t sites = 0;
    uint32_t most_sites = 0; // of one object
    bool touching = false;   // surfaces may touch themselves along edges
};

// Returns about how many triangles the fragments have together if surfaces of `triangles` triangles are cut at `sites` sites.
// Of cubes, rough plates and balls of up to 50,000 triangles at 64 to 512 sites, the fragments had 60 to 95 % of that.
uint32_t usualFragmentTriangles(uint32_t triangles, uint32_t sites);

// Pools for an event of which no more is known. Kernels for rare cases are all recorded, for nobody could record the event
// again; but not those for cells of more than 256 faces, whose first dispatch alone compiles for seconds: an event that meets
// one fails, and its objects stay whole.
Capacities roomForBreaking(const BreakingRoom& room, uint32_t collider_directions = 0);

struct BreakingEvent {
    BreakingRoom room;
    EventGrid grid;
    Capacities capacity;
    uint32_t turn_budget = 0;
    Caps caps = Caps::Exact;
    EventBuffers b; // with counts and dispatch arguments of its own
    GatherBuffers gather;
};
// All but the buffers.
BreakingEvent planBreaking(const engine::Device& device, uint32_t group_size, const BreakingRoom& room,
                           uint32_t collider_directions = 0);
void layOutBreaking(engine::ScratchArena& arena, BreakingEvent& event);

// Wants COUNT_BREAKING, COUNT_SOUP_TRIANGLES, COUNT_SOUP_CORNERS and COUNT_ASKED_SITES published, no more of each than there is
// room for, after everything else in the event's counts and arguments, which `record` is over, was cleared. `breaking`:
// BreakingRecords in order.
//
// Once it has run, COUNT_FRAGMENTS and COUNT_EMITTED tell what stands in the pools: each object's fragments about the center in
// its record, and in the record's units. Nothing does where STATUS_FAILED is set; STATUS_NEEDED then has what a pool that was
// too small would have had to hold.
void recordBreaking(Recorder& record, const BreakingEvent& event, engine::BufferView breaking, const SurfaceList& surfaces,
                    const ScenePools& scene, const ColliderPools& colliders = {});

} // namespace brittle
