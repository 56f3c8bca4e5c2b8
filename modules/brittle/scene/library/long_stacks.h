// Scenes in which stacks stand for a minute, after bug reports of other engines.
#pragma once

#include "modules/brittle/scene/scene_description.h"

namespace brittle::library {

constexpr uint32_t kTallStacks = 12;

SceneDescription tallStack(uint32_t number);           // 34; below kTallStacks: a row of sizes, heights and gravities
SceneDescription heavyDropped(uint32_t ratio);         // 35; kg, on 1 kg
SceneDescription smallHeavyDropped(uint32_t ratio);    // 35; cubes of 10 cm, by three edges
SceneDescription largeHeavyDropped(uint32_t ratio);    // 35; cubes of 10 m, by 0.3 edges
SceneDescription heavyDroppedHard(uint32_t ratio);     // 35; by the hard solver
SceneDescription heavyPlaced(uint32_t ratio);          // 35
SceneDescription heavyCylinderDropped(uint32_t ratio); // 35
SceneDescription tinyBodies(uint32_t unused);          // 43

} // namespace brittle::library
