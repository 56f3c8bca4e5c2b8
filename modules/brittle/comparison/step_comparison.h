// One step on two devices, from the same bytes: which pass is the first to write something else.
//
// Every step is made twice on each device. What a device does not repeat itself is not put down to the other device: lists
// that lanes fill in the order in which they run.
#pragma once

#include "modules/brittle/comparison/buffer_difference.h"
#include "modules/brittle/comparison/step_capture.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brittle {

enum class DifferenceKind : uint8_t {
    Differs,   // the devices computed different values
    Reordered, // the same elements in another order
    Unordered, // a list or a cursor whose order a later pass makes the same
    Unstable,  // a device gives different values when it repeats the step
};
std::string_view nameOf(DifferenceKind kind); // "differs", "reordered", "unordered", "unstable"

// A buffer that a pass left with different contents on the two devices.
struct BufferDifference {
    DifferenceKind kind = DifferenceKind::Differs;
    uint32_t pass_a = 0, pass_b = 0; // indices in the step
    std::string stage, kernel_a, kernel_b;
    std::string slot, buffer;             // name of the kernel's binding; of the world's buffer (StepPlan)
    uint64_t differing = 0, written = 0;  // elements; 0 if only hashes are known
    std::optional<ValueDifference> first; // if the contents are known
};

struct StepComparison {
    uint32_t passes_a = 0, passes_b = 0;
    uint32_t aligned = 0;               // passes that both devices make
    std::vector<BufferDifference> rows; // in the order of the step, at most 20 of the kind Differs
    bool is_cut = false;                // there are more

    // The first row of the kind Differs; nullptr if no row is of that kind.
    const BufferDifference* finding() const;
    size_t differing() const; // rows of the kind Differs
};
// Puts the rows in the order of the step, and leaves out what comes after 20 rows of the kind Differs.
constexpr size_t kMostRowsThatDiffer = 20;
void keepFirstRows(StepComparison& comparison);

// `state_a` and `state_b`: states of World::save, which are the same bytes unless the devices cannot take them. Both worlds are
// left after the step. Errors: those of captureHashes, which begin with "device A" or "device B".
engine::Result<StepComparison> compareStep(ComparedWorld a, ComparedWorld b, std::span<const std::byte> state_a,
                                           std::span<const std::byte> state_b);

// Contents of a buffer after two runs on one device, or after one run that stands for both.
struct RepeatedBuffer {
    const CapturedBuffer& first;
    const CapturedBuffer* second = nullptr; // nullptr: the same as the first
};
// Sets kind, numbers and first value of a row. Returns false if nothing that was written differs.
bool classify(const RepeatedBuffer& a, const RepeatedBuffer& b, BufferDifference& row);

// A list, cursor or hash table that kernels fill by atomics, by the name of its binding. Its contents depend on the order in
// which lanes run.
bool isUnordered(const CapturedBuffer& buffer);

} // namespace brittle
