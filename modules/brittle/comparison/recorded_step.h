// The passes of one step as one device made them, kept so that another machine can compare its own with them.
#pragma once

#include "modules/brittle/comparison/step_comparison.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brittle {

// A buffer that a pass wrote.
struct RecordedBuffer {
    std::string slot, buffer; // as in CapturedBuffer
    uint64_t bytes = 0;
    BufferHashes hashes;
    bool is_stable = true; // a second run gave the same hashes
    bool has_words = false;
    // Index of each 32-bit word that the pass changed, ascending, and its values before and after.
    std::vector<uint32_t> places, before, after;
};

struct RecordedPass {
    std::string key; // keyOf(pass)
    std::string stage, kernel;
    std::vector<RecordedBuffer> written;
};

struct RecordedStep {
    uint32_t step = 0;            // number of the step, from 1
    std::vector<std::byte> state; // of World::save, before the step
    std::vector<RecordedPass> passes;
};

// Makes the step after `state` pass by pass. Changed words are kept up to 64 MiB, pass by pass in order; buffers behind that
// have hashes only. Errors: those of captureHashes.
engine::Result<RecordedStep> recordStep(ComparedWorld compared, uint32_t step, std::span<const std::byte> state);

// Makes the same step on `compared`, from the recorded state. Device A is the one of the recording, device B this one. Rows
// without recorded words have no values. Errors: BadInput if the state is one of another world, those of captureHashes.
engine::Result<StepComparison> compareWithRecorded(ComparedWorld compared, const RecordedStep& recorded);

} // namespace brittle
