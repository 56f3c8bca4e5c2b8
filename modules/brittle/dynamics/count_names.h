// What dispatches are counted by, in words for people.
#pragma once

#include <cstdint>
#include <string>

namespace brittle {

// By the indices of shaders-spirv/shared/solver.h.
std::string nameOfCount(uint64_t count);
// By those of shaders-spirv/shared/fracture.h.
std::string nameOfFractureCount(uint64_t count);

} // namespace brittle
