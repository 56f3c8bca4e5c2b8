// Copies from the device to the host, many in one submission.
#pragma once

#include "engine/buffer.h"
#include "engine/device.h"
#include "engine/result.h"

#include <span>

namespace brittle {

struct Fetch {
    engine::BufferView source;
    void* target;
    size_t bytes; // 0: nothing
};

engine::Result<void> fetch(engine::Device& device, std::span<const Fetch> wanted);

} // namespace brittle
