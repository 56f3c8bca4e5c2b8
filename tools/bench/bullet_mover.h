// Bullet (libbullet-dev) as the mover of a scene, so that the checks of hard cases judge it as they judge Brittle.
//
// Bullet has the bodies, the gravity and the step of the scene, in floats, on one thread, and is set up as its users do:
//   step      a call of stepSimulation for a step of the scene, with the 10 iterations that are its default
//   sleeping  off, since scenes have it off
//   shapes    those of bullet_shapes.h
//   surfaces  friction and restitution of two bodies are what they are in the scene: the geometric mean, and the greater one
//   fast ones continuous collision detection acts on what moves further in a step than half its least extent, with a sphere of
//             that radius: smaller ones let a cube into a wall. Bullet has it for convex shapes and not for compounds
// All else is Bullet's default.
#pragma once

#include "tests/support/mover.h"

namespace bench {

bool hasBullet(); // in this build

// Errors: Feature where Bullet is not in the build, or where the scene has effects that Bullet has not.
engine::Result<std::unique_ptr<support::Mover>> makeBulletMover(const brittle::SceneDescription& scene,
                                                                const brittle::WorldContents& contents);

} // namespace bench
