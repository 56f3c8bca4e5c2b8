// A step of a world as it is recorded, stage by stage.
#pragma once

#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/dynamics/world_buffers.h"
#include "modules/brittle/fracture/recorder.h"

#include <optional>

namespace brittle {

struct Step {
    const StepSettings& settings;
    const WorldBuffers& b;
    const PairMemory& last; // of the step before
    const PairMemory& now;
    engine::KernelLibrary& kernels;
    Recorder& record;
    bool many_lanes; // the device has them
    bool bounces;    // some body does

    bool has(Effect effect) const { return b.sizes.effects.has(effect); }
};

void recordBoxes(const Step& step);
engine::Result<void> recordContacts(const Step& step); // pairs, points, and what is remembered of them
// The points of such pairs, as far ahead as contacts are looked for, into the step's manifolds.
engine::Result<void> recordPoints(const Step& step, const NarrowPhaseInput& input, const Float3& gravity);
void recordIslands(const Step& step); // and which of them sleep
void recordColors(const Step& step);
void recordSolve(const Step& step);
void recordRest(const Step& step); // where bodies may sleep
// Where there are events; `breakable`: gpu::BreakableBody, where bodies break.
void recordImpacts(const Step& step, const std::optional<engine::BufferView>& breakable);
void recordEnd(const Step& step);

gpu::SolverPush solverPush(const Step& step);
gpu::vec4 fallingOf(const Step& step); // gravity; w: length of the step

} // namespace brittle
