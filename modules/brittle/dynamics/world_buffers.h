// Where everything of a world lies on the device.
#pragma once

#include "engine/arena.h"
#include "engine/buffer.h"
#include "engine/device.h"
#include "modules/brittle/dynamics/broad_phase.h"
#include "modules/brittle/dynamics/narrow_phase.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/effects/effect_set.h"
#include "shaders-spirv/shared/solver.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brittle {

struct WorldSizes {
    uint32_t bodies = 0, pieces = 0, pairs = 0, contacts = 0;
    EffectSet effects;
};

// What a step makes and the next one reads; two of them take turns.
struct PairMemory {
    engine::BufferView pairs, count, contacts; // uvec2 sorted, one word, gpu::ContactMemory a pair
};

// Made anew in every step.
struct StepBuffers {
    engine::BufferView box_low, box_high, recalled, fresh, fresh_slots, sums, fresh_pairs, manifolds, axes, first_hits, narrow_arguments,
        touches, contact_offsets, contact_pairs, contact_slots, solver_bodies, spins, shares, solver_contacts, hits,
        body_colors, bids, waiting, color_start, parents, islands, rests, island_contacts, island_ranges, listed, color_ends,
        heights, members, adjacency_counts, adjacency_start, adjacency_cursors, loose_adjacency, adjacency;
    BroadPhaseScratch broad_phase;
};

// What a view is for, and which effect asked for it.
struct NamedBuffer {
    std::string name;
    engine::BufferView view;
    VkDeviceSize bytes = 0;         // 0: nobody asked for it, and the view is that of the dummy
    std::optional<Effect> asked_by; // none: every world has it
    bool is_shared = false;         // by lists of which one is done with before another begins
};

struct WorldBuffers {
    engine::BufferView hull_records, hull_vertices, hull_faces, hull_corners, hull_edges;
    engine::BufferView pieces, bodies, shapes;
    engine::BufferView counts, args;          // as a fracture event's (shared/fracture.h), indices in shared/solver.h
    engine::BufferView steps;                 // shared/solver.h, STEPS_*
    engine::BufferView births;                // gpu::Birth, by slot of a body
    engine::BufferView impacts_told, impacts; // shared/impact.h
    std::array<PairMemory, 2> memory;
    StepBuffers step;
    std::vector<NamedBuffer> named; // all of these, the dummy among them
    std::vector<std::unique_ptr<engine::Buffer>> owned;
    std::unique_ptr<engine::ScratchArena> arena;
    WorldSizes sizes;
    uint32_t movers = 0; // bodies that are not fixed
    BroadPhaseBudget broad_phase;

    HullPools hulls() const { return {hull_records, hull_vertices, hull_faces, hull_corners, hull_edges}; }
};

// The most pairs there can be room for: all of what the solver knows of them is bound at once.
uint32_t mostPairs(const engine::Device& device);

// Fills what the contents say and clears the rest; pairs: at most mostPairs; contacts: 0 for as many as pairs. What no effect
// of the set asks for has no bytes of its own: all of that is one dummy of 16 bytes. Errors: Capacity, with the list that the
// device cannot bind; Device.
engine::Result<WorldBuffers> makeWorldBuffers(engine::Device& device, const WorldContents& contents, uint32_t pairs,
                                              uint32_t contacts, EffectSet effects);

} // namespace brittle
