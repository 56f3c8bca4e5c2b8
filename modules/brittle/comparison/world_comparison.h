// The same scene on two devices: after which step the motion differs, and which pass of that step is the cause.
#pragma once

#include "modules/brittle/comparison/motion_difference.h"
#include "modules/brittle/comparison/step_comparison.h"

#include <functional>
#include <optional>

namespace brittle {

struct ComparisonOptions {
    uint32_t steps = 0;                          // to make, at most
    bool whole = false;                          // goes on to the last step after the first difference
    std::function<void(uint32_t step)> progress; // called before each step, with its number from 1; may be empty
};

// A difference that was traced to a step.
struct TracedStep {
    uint32_t step = 0; // number of the step, from 1
    StepComparison comparison;
    bool from_same_state = true; // both devices began with the same bytes, else each with its own
};

struct WorldComparison {
    uint32_t steps = 0;                       // made by both worlds
    std::optional<uint32_t> first_difference; // number of the step, from 1, after which bodies differ for the first time
    std::optional<BodyDifference> body;       // what differs then
    std::optional<TracedStep> traced;         // if bodies differ
    MotionDifference motion;                  // after the last step that was made
};

// Steps both worlds, which have the same contents, settings and budget. The state of device A before the step in question is
// restored into both worlds and the step is repeated pass by pass. If no pass differs then, up to seven steps before are
// repeated the same way: memory of contacts may differ earlier than bodies. The worlds are left in some state.
// Errors: those of World::step, World::save and compareStep, beginning with "device A" or "device B".
engine::Result<WorldComparison> compareWorlds(ComparedWorld a, ComparedWorld b, const ComparisonOptions& options);

} // namespace brittle
