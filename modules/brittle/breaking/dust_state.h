// Dust, as the host reads it.
#pragma once

#include "shaders-spirv/shared/dust.h"

#include <cstdint>
#include <vector>

namespace brittle {

struct DustAmount {
    uint64_t particles = 0;
    double mass = 0; // kg, a sum without rounding up to some thousands of kg
};

// All that was made flies, has settled after its time, or was overwritten where there was no room for more.
struct Dust {
    std::vector<gpu::DustParticle> flying; // the oldest first; bodies as the world numbers them
    DustAmount made, settled, overwritten;
    DustAmount inTheAir() const;
};

} // namespace brittle
