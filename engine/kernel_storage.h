// What a kernel keeps beside its buffers: memory that its group shares, and variables that each lane has for itself.
#pragma once

#include "engine/pipeline.h"

#include <cstdint>
#include <span>
#include <string>

namespace engine {

struct KernelStorage {
    struct Part {
        uint64_t bytes = 0;
        std::string largest; // of its variables, by name
        uint64_t largest_bytes = 0;
    };
    Part shared; // of a group, with the padding of std430
    Part lane;   // that the module still has; a compiler may keep fewer, or copies
};

// Specialized with these constants, with the module's own values for all others; arrays may have lengths reckoned from them.
// Words that are no SPIR-V have none.
KernelStorage storageOf(std::span<const uint32_t> words, std::span<const SpecConstant> constants);

} // namespace engine
