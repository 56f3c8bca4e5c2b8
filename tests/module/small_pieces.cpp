#include "tests/module/small_pieces.h"

#include <gtest/gtest.h>

namespace small_pieces {

using brittle::Double3, brittle::operator+, brittle::operator*;

namespace {

void add(brittle::SceneDescription& scene, const std::vector<std::string>& effects) {
    scene.effects.insert(scene.effects.end(), effects.begin(), effects.end());
}

} // namespace

brittle::SceneDescription sceneOf(std::vector<brittle::BodyDescription> bodies, const std::vector<std::string>& effects) {
    brittle::SceneDescription scene = breaking_scenes::sceneOf(std::move(bodies));
    add(scene, effects);
    return scene;
}

brittle::SceneDescription shot(const std::vector<std::string>& effects) {
    brittle::SceneDescription scene = breaking_scenes::shot(8, "concrete");
    scene.bodies[0].spin = {3, -2, 5};
    add(scene, effects);
    return scene;
}

std::vector<gpu::BreakEvent> firstBreaks(brittle::World& world) { return breaking_scenes::stepUntilItBreaks(world, 120); }

brittle::Dust dustOf(brittle::World& world) {
    const auto dust = world.dust();
    EXPECT_TRUE(dust);
    return *dust;
}

brittle::WorldCounts countsOf(brittle::World& world) {
    const auto counts = world.counts();
    EXPECT_TRUE(counts);
    return *counts;
}

Double3 placeOf(const gpu::DustParticle& particle) {
    const auto along = [](int32_t sector, float offset) { return double{SECTOR_EDGE} * sector + double{offset}; };
    return {along(particle.sector.x, particle.place.x), along(particle.sector.y, particle.place.y),
            along(particle.sector.z, particle.place.z)};
}

breaking_scenes::Motion motionOf(const std::vector<gpu::DustParticle>& particles) {
    breaking_scenes::Motion sum;
    for (const gpu::DustParticle& particle : particles) {
        const double mass = particle.velocity.w;
        sum.mass += mass;
        sum.momentum = sum.momentum + mass * breaking_scenes::vectorOf(particle.velocity);
    }
    return sum;
}

} // namespace small_pieces
