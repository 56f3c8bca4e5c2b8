// How deep bodies lie in each other, in double precision, whoever moved them: a world or another library.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"
#include "tests/reference/convex.h"

#include <span>
#include <vector>

namespace support {

struct Pose {
    brittle::Double3 place = {0, 0, 0}; // of the center of mass
    brittle::Turn turn = {0, 0, 0, 1};  // of any length but 0
};
Pose poseOf(const gpu::BodyState& body);

reference::Convex pieceInWorld(const brittle::WorldContents& contents, size_t piece, const Pose& pose);

// Of pieces of different bodies that do not both stand still, one pose a body; the deepest last. Pairs that do not overlap are
// left out.
std::vector<double> overlapsOf(const brittle::WorldContents& contents, std::span<const Pose> poses);

// Of sorted values; 0 of none.
double percentile(const std::vector<double>& sorted, double share);

} // namespace support
