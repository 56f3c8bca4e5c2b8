// Runs code that cannot be trusted with broken input in a process of its own: whatever it does there, crash, hang or eat all
// memory, the caller lives on and learns of it.
#pragma once

#include "engine/result.h"

#include <cstdint>
#include <functional>
#include <string>

namespace brittle {

struct IsolationLimits {
    uint32_t seconds = 120;
    uint64_t bytes = uint64_t{8} << 30; // of address space, beyond what the process has already
};

// What `work` returned, bytes and all. The child shares nothing with its parent afterwards and must not touch a device.
engine::Result<std::string> runIsolated(const std::function<std::string()>& work, const IsolationLimits& limits = {});

// False under the address sanitizer, which reserves terabytes of addresses for itself.
bool isolationLimitsMemory();

} // namespace brittle
