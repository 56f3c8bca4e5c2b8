// Which colors bodies have in pictures. All are linear.
#pragma once

#include "modules/brittle/dynamics/body_surface.h"
#include "shaders-spirv/shared/scene.h"

namespace cli {

// Of what moves one of many hues, neighbors in number far apart; fragments about that of the body that broke; cut faces darker.
// What does not move is gray, and planes fade out so far from the eye.
gpu::ObjectColor colorOf(const brittle::BodyLook& look, size_t number, double fading_distance);
// Of dust of a body of the beginning: its own, paler and without shade.
gpu::ObjectColor dustColor(const brittle::BodyLook& look, size_t number);
// Of all that lies on a plane.
gpu::ObjectColor shadowColor(double fading_distance);

} // namespace cli
