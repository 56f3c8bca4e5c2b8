// A scene at another size, with the same motion under the same gravity.
//
//   places, sizes, points, scales of meshes, margin, smallest_piece, debris.below    times S
//   dt, lifetime of dust, debris.after and debris.fade                               times the root of S
//   velocities, bounce_speed, push_out, impact_speed                                 times the root of S
//   spins, contact_hertz                                                             divided by the root of S
//   masses                                                                           times S^3
//   strength of cells, an energy                                                     times S^4
//
// 0 keeps its meaning, a default. Gravity, densities, friction, restitution, damping, drag, counts and the camera stay.
// Materials stay as well, so a scene whose bodies break does not break alike. sleep_speed is no part of a description.
#pragma once

#include "modules/brittle/scene/scene_description.h"

namespace support {

brittle::SceneDescription scaled(brittle::SceneDescription scene, double scale); // scale: above 0

} // namespace support
