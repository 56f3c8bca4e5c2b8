// A scene on this machine against a motion that another one has recorded.
#pragma once

#include "modules/brittle/comparison/world_comparison.h"
#include "tools/compare/motion_recording.h"

namespace compare {

struct RecordingOptions {
    uint32_t steps = 0;
    uint32_t passes_of = 0; // number of the step, from 1, whose passes are recorded as well; 0: none
    std::function<void(uint32_t step)> progress;
};

// Makes so many steps and keeps the bodies after each. `passes_of` is at most `steps`. Errors: those of World::step and
// brittle::recordStep. Names of scene and device are left to the caller.
engine::Result<MotionRecording> recordMotion(brittle::ComparedWorld compared, const RecordingOptions& options);

// Compares the bodies after each step, and the passes of the recorded step if there are any. Device A is the one of the
// recording. Errors: BadInput if the recording has fewer steps or is of other bodies; those of World::step and
// brittle::compareWithRecorded.
engine::Result<brittle::WorldComparison> compareWithRecording(brittle::ComparedWorld compared, const MotionRecording& recording,
                                                              const brittle::ComparisonOptions& options);

} // namespace compare
