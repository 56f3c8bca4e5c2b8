// Stacks of boxes as the reference steps them (tests/reference/rigid_stack.h), made of a scene, and how far a world is from
// that.
#pragma once

#include "engine/result.h"
#include "tests/reference/rigid_stack.h"
#include "tests/support/measured_scene.h"

namespace support {

// The boxes of a scene whose last body is followed by the ground. Errors: BadInput, for what is no such stack.
engine::Result<std::vector<reference::StackedBox>> stackedBoxes(const brittle::SceneDescription& scene);
reference::StackSettings stackSettings(const brittle::SceneDescription& scene);

// The furthest that any body is from what the oracle says of it: places in edges of a cube, turns in radians, velocities in
// what gravity adds in a step, spins in that speed an edge.
struct StackDifference {
    double place = 0, turn = 0, velocity = 0, spin = 0;
};
StackDifference differenceOf(const MeasuredScene& run, const reference::RigidStack& stack);

} // namespace support
