// Narrow phase: where pairs of pieces touch, by the separating axis theorem and clipping (the paper, section 6; Sutherland and
// Hodgman 1974), swept over the step for pairs that move fast.
//
// Hulls are exact: nothing is shrunk, and no margin is added. Points are reported up to the speculative distance apart, or up
// to a tenth of the smaller piece's radius where that is less, so that chips are not held off the ground. A pair that is
// further apart and moves by more than this distance in the step is swept: if the hulls, moved by their bodies' velocities,
// meet before the step is over, the pair has points along the axis of the first impact, with the way left along it as their
// separation. Turning is not swept.
#pragma once

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/kernel.h"
#include "modules/brittle/mesh/mesh.h"

#include <cstdint>
#include <optional>

namespace brittle {

struct HullPools {
    engine::BufferView records;  // gpu::HullRecord
    engine::BufferView vertices; // gpu::vec4
    engine::BufferView faces;    // gpu::HullFace
    engine::BufferView corners;  // uint32_t
    engine::BufferView edges;    // gpu::uvec4
};

// Of fragments that have just come apart; kernels specialized with SIBLINGS_ID 1 want it, others do not look at it.
struct NewSiblings {
    engine::BufferView births; // gpu::Birth, by body
    engine::BufferView steps;  // STEPS_*
};

struct NarrowPhaseInput {
    HullPools hulls;
    engine::BufferView pieces; // gpu::PieceRecord
    engine::BufferView bodies; // gpu::BodyState
    engine::BufferView pairs;  // two uint32_t each: pieces, the lower one first, of different bodies
    engine::BufferView counts; // uint32_t, on the device
    uint32_t count_at = 0;     // which of them is the number of pairs; at most `capacity` are looked at
    uint32_t capacity = 0;     // pairs that `pairs` and the outputs have room for
    std::optional<NewSiblings> siblings = std::nullopt;
    // gpu::FirstHits by body, all bits set: what a body meets first hides what it would meet behind that. Without it nothing is hidden.
    std::optional<engine::BufferView> first_hits = std::nullopt;
};

struct NarrowPhaseOptions {
    float speculative = 0.02f;  // m, not negative
    float duration = 1.0f / 60; // of the step in seconds, not negative; 0 sweeps nothing
    Float3 gravity = {0, 0, 0}; // m/s2: what moves falls over the step, which counts where it is swept
    float step = 0;             // s, not negative
    float strip = 0;            // m, not negative: hulls that overlap by less are a floor of several pieces (seams); 0: none
    uint32_t fixed_axes = 0;    // 0: all axes of both hulls; 6, 14, 26 or 62 directions of the world: the paper's fixed set
};

// Buffers of the caller: bytes that `capacity` pairs take.
struct NarrowPhaseOutput {
    engine::BufferView manifolds; // gpu::Manifold a pair, in the order of the pairs; info.x == 0: they do not touch
    engine::BufferView axes;      // scratch, gpu::AxisRecord a pair
    engine::BufferView arguments; // scratch, kNarrowPhaseArgumentBytes
};

constexpr uint32_t kNarrowPhaseArgumentBytes = 32;

// Whether a pair has more lanes on it: where many run side by side.
inline bool hasManyLanes(const engine::Device& device) { return device.subgroupSize() >= 32; }

// Records the kernels. BadInput for options out of range, Capacity for outputs that are too small.
engine::Result<void> recordNarrowPhase(engine::Commands& commands, engine::KernelLibrary& kernels,
                                       const NarrowPhaseInput& input, const NarrowPhaseOptions& options,
                                       const NarrowPhaseOutput& output, bool many_lanes);

} // namespace brittle
