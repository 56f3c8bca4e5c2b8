// Where everything lies that a world knows of bodies that can break, but for what fracturing itself needs (fracture/pools.h).
#pragma once

#include "modules/brittle/breaking/break.h"
#include "modules/brittle/breaking/world_pools.h"
#include "modules/brittle/dynamics/world_buffers.h"
#include "modules/brittle/fracture/scene_buffers.h"

#include <vector>

namespace brittle {

// From step to step, and saved with the world.
struct LastingBuffers {
    engine::BufferView breakable, cards, surface_vertices;
    engine::BufferView told, ring; // of events; empty without that effect
};

// Made anew in every step.
struct PassingBuffers {
    engine::BufferView blows, soonest, hardest, chosen, breaking, broken, reach_sums, cracks, size_shares, ledger, adopted,
        returned;
    engine::BufferView owners, order, other_owners, other_order, sizes, begins, rooms, owner_start, lacking;
    engine::BufferView histogram, digit_offsets, sums;
    engine::BufferView turning, posed_bodies, posed_pieces, posed_pairs; // blows of bodies that turn, and the two as they meet
};

struct BreakingSizes {
    uint32_t pairs = 0, bodies = 0, fragments = 0; // fragments: of a step
};

LastingBuffers layOutLasting(engine::ScratchArena& arena, const WorldContents& contents, EffectSet effects);
PassingBuffers layOutPassing(engine::ScratchArena& arena, const BreakingSizes& sizes);

// By name, for the plan. What fracturing needs is one range, in which lists of one stage lie where those of another lay: it
// stands behind its counts and arguments, which it holds.
std::vector<NamedBuffer> namedBuffers(const LastingBuffers& lasting, const PassingBuffers& passing, const PoolBuffers& pools);
std::vector<NamedBuffer> namedBuffers(const EventBuffers& event, const NamedBuffer& range);
std::vector<NamedBuffer> namedBuffers(const ScenePools& scene, const ColliderPools& colliders);

} // namespace brittle
