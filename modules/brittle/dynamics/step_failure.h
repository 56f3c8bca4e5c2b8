// Why a step was not made.
#pragma once

#include "modules/brittle/dynamics/world_buffers.h"

#include <span>

namespace brittle {

struct TriedStep {
    uint64_t number = 0;          // counted from 1
    bool has_pair_budget = false; // or there is room for as many as the device has room for
};

// From the words of counts and status that it left. Errors: Capacity, with what it lacked and what to do.
engine::Result<void> failureOf(std::span<const uint32_t> words, const WorldSizes& room, const TriedStep& step);

} // namespace brittle
