#include "tools/compare/recording_comparison.h"

namespace compare {

using brittle::ComparedWorld;
using engine::Error;
using engine::ErrorCode;
using engine::Result;

Result<MotionRecording> recordMotion(ComparedWorld compared, const RecordingOptions& options) {
    MotionRecording recording;
    std::vector<std::byte> state;
    for (uint32_t step = 1; step <= options.steps; ++step) {
        if (options.progress) options.progress(step);
        if (step == options.passes_of) {
            auto saved = compared.world.save();
            if (!saved) return saved.error();
            state = std::move(*saved);
        }
        if (auto stepped = compared.world.step(); !stepped) return stepped.error();
        auto bodies = compared.world.bodies();
        if (!bodies) return bodies.error();
        recording.steps.push_back(std::move(*bodies));
    }
    if (options.passes_of == 0) return recording;
    auto passes = brittle::recordStep(compared, options.passes_of, state);
    if (!passes) return passes.error();
    recording.passes = std::move(*passes);
    return recording;
}

Result<brittle::WorldComparison> compareWithRecording(ComparedWorld compared, const MotionRecording& recording,
                                                      const brittle::ComparisonOptions& options) {
    if (recording.steps.size() < options.steps)
        return Error{ErrorCode::BadInput, "the recording has " + std::to_string(recording.steps.size()) + " steps, " +
                                              std::to_string(options.steps) +
                                              " are to be compared; record more, or ask for fewer"};
    brittle::WorldComparison found;
    for (; found.steps < options.steps && (!found.first_difference || options.whole);) {
        if (options.progress) options.progress(found.steps + 1);
        if (auto stepped = compared.world.step(); !stepped) return stepped.error();
        const std::vector<gpu::BodyState>& recorded = recording.steps[found.steps++];
        const auto bodies = compared.world.bodies();
        if (!bodies) return bodies.error();
        found.motion = brittle::motionDifference(recorded, *bodies);
        if (found.first_difference) continue;
        found.body = brittle::firstBodyDifference(recorded, *bodies);
        if (found.body) found.first_difference = found.steps;
    }
    if (!recording.passes) return found;
    auto passes = brittle::compareWithRecorded(compared, *recording.passes);
    if (!passes) return passes.error();
    found.traced = brittle::TracedStep{recording.passes->step, std::move(*passes)};
    return found;
}

} // namespace compare
