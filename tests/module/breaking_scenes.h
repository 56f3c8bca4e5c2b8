// Small worlds in which something breaks, for tests of what happens then.
#pragma once

#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/scene_description.h"

#include <memory>
#include <vector>

namespace breaking_scenes {

constexpr double kBall = 0.1; // m, radius

brittle::BodyDescription ball(brittle::Double3 place, const char* material);
// Bodies that break where their material does, above a floor or in empty space.
brittle::SceneDescription sceneOf(std::vector<brittle::BodyDescription> bodies, bool floor = true);
// In empty space: a ball that breaks, and one that does not, which hits it off its middle. Far enough away to fly a while.
brittle::SceneDescription shot(double speed, const char* material);
std::unique_ptr<brittle::World> worldOf(const brittle::SceneDescription& scene, const brittle::WorldBudget& budget = {});

void step(brittle::World& world, uint32_t steps = 1);
// Steps until something breaks, for so many steps at most, and returns what did.
std::vector<gpu::BreakEvent> stepUntilItBreaks(brittle::World& world, uint32_t most);

// The same with steps of three lengths: energies and counts of what breaks are alike but for these shares.
void expectAlikeInStepsOfAnyLength(brittle::SceneDescription scene, double energy_share, double count_share);

// That are there and move.
std::vector<gpu::BodyState> presentBodies(brittle::World& world);
double massOf(const std::vector<gpu::BodyState>& bodies);

struct Motion {
    double mass = 0, energy = 0;
    brittle::Double3 momentum = {0, 0, 0}, angular = {0, 0, 0};
};
Motion motionOf(const std::vector<gpu::BodyState>& bodies);

brittle::Double3 vectorOf(const gpu::vec4& v);
double sizeOf(const brittle::Double3& v);

} // namespace breaking_scenes
