// A motion in a file: the states of all bodies after every step on one device, for another machine to compare its own with.
#pragma once

#include "modules/brittle/comparison/recorded_step.h"
#include "modules/brittle/export/output_file.h"
#include "shaders-spirv/shared/body.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace compare {

struct MotionRecording {
    std::string scene, device, driver;
    double dt = 0;                                  // seconds per step
    std::vector<std::vector<gpu::BodyState>> steps; // bodies after each step, as World::bodies returns them
    std::optional<brittle::RecordedStep> passes;    // of one step, if they were asked for
};

// Writes and commits a file that was opened before the motion was made. Errors: BadInput if it cannot be written.
engine::Result<void> writeRecording(brittle::OutputFile& file, const MotionRecording& recording);

// Errors: BadInput for a file that cannot be read or is no recording, with its name.
engine::Result<MotionRecording> readRecording(const std::filesystem::path& path);

} // namespace compare
