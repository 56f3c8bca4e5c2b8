// Reads back the buffers that each pass of one step writes.
#pragma once

#include "engine/device.h"
#include "modules/brittle/dynamics/world.h"

#include <compare>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace brittle {

// A world and the device that it lives on; both belong to the caller.
struct ComparedWorld {
    engine::Device& device;
    World& world;
};

// Fingerprints of a buffer after a pass; all 0 if the pass changed nothing.
struct BufferHashes {
    uint64_t whole = 0;     // of all bytes
    uint64_t changes = 0;   // of the words that the pass changed, with their places
    uint64_t unordered = 0; // of the elements that the pass changed, in any order
    bool operator==(const BufferHashes&) const = default;
};

// A buffer that a pass writes.
struct CapturedBuffer {
    std::string slot;   // name of the kernel's binding; "" of fills and copies
    std::string buffer; // one of StepPlan::buffers
    std::vector<engine::ReflectedField> fields;
    uint64_t bytes = 0;
    BufferHashes hashes;
    std::vector<std::byte> before, after; // of `bytes` bytes if they were asked for, else empty
};

struct CapturedPass {
    Pass pass;
    std::vector<CapturedBuffer> written;
};

using StepCapture = std::vector<CapturedPass>;

// Names a buffer of a capture by the index of its pass and by its place in CapturedPass::written.
struct BufferId {
    uint32_t pass = 0, buffer = 0;
    auto operator<=>(const BufferId&) const = default;
};

// Restores a state of World::save and makes the step that follows. Returns every pass in order, with hashes of all that it
// writes. Errors: those of World::restore and World::probeStep.
engine::Result<StepCapture> captureHashes(ComparedWorld compared, std::span<const std::byte> state);

// The same with the bytes of some buffers instead of hashes.
engine::Result<StepCapture> captureContents(ComparedWorld compared, std::span<const std::byte> state,
                                            const std::set<BufferId>& wanted);

} // namespace brittle
