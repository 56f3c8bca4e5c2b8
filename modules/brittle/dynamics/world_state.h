// All that a world's next step depends on, as bytes: how long each of its buffers is, then what is in them.
#pragma once

#include "engine/buffer.h"
#include "engine/device.h"
#include "engine/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brittle {

struct StateView {
    engine::BufferView view;
    bool grows = false; // a world may have made more room here since a state was saved, or before
};

// How much of what the device tells the host has heard.
struct HeardSoFar {
    uint32_t breaks = 0, impacts = 0;
};

engine::Result<std::vector<std::byte>> readState(engine::Device& device, std::span<const StateView> views,
                                                 const HeardSoFar& heard);

struct StateHead {
    HeardSoFar heard;
    std::vector<uint64_t> sizes; // bytes of each buffer
};
// Errors: BadInput for what is no state of such buffers, or not all of it. Only of those that grow there may be more in it.
engine::Result<StateHead> headOf(std::span<const std::byte> state, std::span<const StateView> views);
// Of a state that was found sound, into views that have grown as far as it has. Where there is more room it begins the buffer.
engine::Result<void> writeState(engine::Device& device, std::span<const std::byte> state, std::span<const StateView> views);

uint64_t hashOf(std::span<const std::byte> bytes); // FNV-1a

} // namespace brittle
