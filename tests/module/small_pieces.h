// Worlds in which something breaks into pieces that are too small to be bodies, or to stay.
#pragma once

#include "modules/brittle/dynamics/pose.h"
#include "tests/module/breaking_scenes.h"

#include <string>
#include <vector>

namespace small_pieces {

// Bodies that break above a floor; with these effects besides.
brittle::SceneDescription sceneOf(std::vector<brittle::BodyDescription> bodies, const std::vector<std::string>& effects = {});
// In empty space, without gravity: a ball of concrete that spins breaks when another one hits it off its middle.
brittle::SceneDescription shot(const std::vector<std::string>& effects = {});
// What broke first, within two seconds; empty where nothing does.
std::vector<gpu::BreakEvent> firstBreaks(brittle::World& world);

brittle::Dust dustOf(brittle::World& world);
brittle::WorldCounts countsOf(brittle::World& world);
breaking_scenes::Motion motionOf(const std::vector<gpu::DustParticle>& particles);
brittle::Double3 placeOf(const gpu::DustParticle& particle);

} // namespace small_pieces
