// Scenes of spinning, sliding, bouncing, bearing and hitting, after bug reports of other engines.
#pragma once

#include "modules/brittle/scene/scene_description.h"

namespace brittle::library {

constexpr uint32_t kSliders = 12;

SceneDescription spinningRods(uint32_t count);     // 12
SceneDescription slider(uint32_t number);          // 36; below kSliders: a row of floors and speeds
SceneDescription elasticDrop(uint32_t meters);     // 37
SceneDescription elasticTilted(uint32_t count);    // 37; cubes at any tilt, that many
SceneDescription elasticTumbling(uint32_t meters); // 37; one cube at a tilt, for 20 s
SceneDescription cradle(uint32_t gap_millimeters); // 38
SceneDescription arch(uint32_t stones);            // 39
SceneDescription longArch(uint32_t stones);        // 39; for a minute
SceneDescription compoundsAtWall(uint32_t speed);  // 40; m/s
SceneDescription steepSlope(uint32_t percent);     // 41; of the slope at which friction gives way

} // namespace brittle::library
