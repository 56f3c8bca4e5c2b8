// How far two motions of the same scene are apart.
#pragma once

#include "shaders-spirv/shared/body.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace brittle {

// Largest differences among bodies that exist in both worlds, each of its own body.
struct MotionDifference {
    double position_m = 0;           // distance of the centers of mass
    double rotation_rad = 0;         // angle from one rotation to the other
    double linear_velocity = 0;      // length of the difference, m/s
    uint32_t body = 0;               // the one with the largest difference in position; an index into the lists
    uint32_t bodies = 0;             // that exist in both worlds
    uint32_t only_a = 0, only_b = 0; // bodies that exist in one world alone
};

// Bodies as World::bodies returns them: those with the same index are compared, absent ones are left out.
MotionDifference motionDifference(std::span<const gpu::BodyState> a, std::span<const gpu::BodyState> b);

struct BodyDifference {
    uint32_t body = 0;  // index into the lists
    std::string member; // of gpu::BodyState, "velocity.y"
    std::string a, b;   // values as text
};
// The first number that differs, body by body. Nothing if all bits are the same. If one list is shorter, its next body counts
// as the first difference, with the member "body".
std::optional<BodyDifference> firstBodyDifference(std::span<const gpu::BodyState> a, std::span<const gpu::BodyState> b);

} // namespace brittle
