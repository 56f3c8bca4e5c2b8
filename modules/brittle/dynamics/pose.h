// Where bodies are, in double precision, for what is made of a world's states on the host.
#pragma once

#include "modules/brittle/dynamics/world_contents.h"

#include <optional>
#include <span>
#include <vector>

namespace brittle {

// From the frame that has been turned to the one outside, and back. `turn` of any length but 0.
Double3 turnedBy(const Turn& turn, const Double3& v);
Double3 turnedBack(const Turn& turn, const Double3& v);

struct Pose {
    Double3 place = {0, 0, 0}; // of the center of mass
    Turn turn = {0, 0, 0, 1};  // unit
    double scale = 1;          // of one that fades, about its center of mass, down to 0
};

Pose poseOf(const gpu::BodyState& body);
// Of bodies at a moment, one each; none for what is not there yet or any more.
using Poses = std::vector<std::optional<Pose>>;

// On the way from `a` (share 0) to `b` (share 1): straight on, and turning evenly by the shorter way.
Pose between(const Pose& a, const Pose& b, double share);
// Of the bodies that are there at `a`: what is not at `b` any more stays where it was.
Poses between(const Poses& a, const Poses& b, double share);

// J, of all that moves and turns.
double kineticEnergyOf(std::span<const gpu::BodyState> bodies);

// What floats are best counted from: the middle of what moves, in steps of 1024 m, so the origin itself for all that is near
// it.
Double3 originOf(std::span<const gpu::BodyState> bodies);

} // namespace brittle
