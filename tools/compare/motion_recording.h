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
    uint64_t scene_hash = 0;                        // of its description and models (scene_hash.h)
    uint32_t group_size = 0;                        // lanes of a workgroup
    double dt = 0;                                  // seconds per step
    std::vector<std::vector<gpu::BodyState>> steps; // bodies after each step, as World::bodies returns them
    std::optional<brittle::RecordedStep> passes;    // of one step, if they were asked for
};

// Writes and commits a file that was opened before the motion was made. Errors: BadInput if it cannot be written.
engine::Result<void> writeRecording(brittle::OutputFile& file, const MotionRecording& recording);

// Errors: BadInput, with the file's name, for a file that cannot be read, is no recording, is damaged, is of another format, or
// has no steps, no bodies, or passes of a step that it does not have.
engine::Result<MotionRecording> readRecording(const std::filesystem::path& path);

} // namespace compare
