// The scenes that break rigid-body engines, by subject. The numbers in the names of the built-in scenes are theirs; the
// parameter is what a scene exists in several sizes of. y is up, gravity 10 m/s2, a step is a sixtieth of a second.
#pragma once

#include "modules/brittle/scene/scene_description.h"

namespace brittle::library {

// hard_blocks.cpp: pieces that touch everywhere.
SceneDescription weightlessBlock(uint32_t cells);        // 1
SceneDescription standingBlock(uint32_t cells);          // 2
SceneDescription overlappingCubes(uint32_t millimeters); // 3
SceneDescription inflatedBlock(uint32_t micrometers);    // 4
SceneDescription farBody(uint32_t cells);                // 22
SceneDescription crowdedSlab(uint32_t cubes);            // 23

// hard_stacks.cpp: what stands.
SceneDescription stack(uint32_t cubes);          // 5
SceneDescription heavyOnLight(uint32_t ratio);   // 6
SceneDescription cardHouse(uint32_t levels);     // 7
SceneDescription farStack(uint32_t kilometers);  // 19
SceneDescription shortStack(uint32_t cubes);     // 30
SceneDescription scaledStack(uint32_t edge_mm);  // 31
SceneDescription weighedStack(uint32_t density); // 31
SceneDescription restingBlock(uint32_t steps);   // 33

// hard_motion.cpp: what spins, flies, slides and bounces.
SceneDescription intermediateAxis(uint32_t);           // 8
SceneDescription thinRod(uint32_t);                    // 9
SceneDescription cubeAtWall(uint32_t speed);           // 10
SceneDescription cubeAtPlate(uint32_t speed);          // 11
SceneDescription cubesHeadOn(uint32_t speed);          // 13
SceneDescription flatPlate(uint32_t millimeters);      // 14
SceneDescription slivers(uint32_t millimeters);        // 15
SceneDescription slope(uint32_t friction_percent);     // 16
SceneDescription bounce(uint32_t restitution_percent); // 17

// hard_piles.cpp: many random hulls.
SceneDescription implosion(uint32_t hulls);  // 18
SceneDescription hullPile(uint32_t hulls);   // 20
SceneDescription overflow(uint32_t hulls);   // 24
SceneDescription longPile(uint32_t hulls);   // 29
SceneDescription sleepyPile(uint32_t hulls); // 32

} // namespace brittle::library
