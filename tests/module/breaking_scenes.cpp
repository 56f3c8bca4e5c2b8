#include "tests/module/breaking_scenes.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/fracture/fracture.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <cmath>

namespace breaking_scenes {

using brittle::Double3, brittle::operator+, brittle::operator*;
using brittle::SceneDescription, brittle::BodyDescription;

BodyDescription ball(brittle::Double3 place, const char* material) {
    BodyDescription body;
    body.shape.kind = brittle::ShapeKind::Ball;
    body.shape.radius = kBall;
    body.place = place;
    body.material = material;
    return body;
}

SceneDescription sceneOf(std::vector<BodyDescription> bodies, bool floor) {
    SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction", "impact_fracture", "events"};
    scene.bodies = std::move(bodies);
    if (floor) scene.colliders.push_back({});
    return scene;
}

std::unique_ptr<brittle::World> worldOf(const SceneDescription& scene, const brittle::WorldBudget& budget) {
    const auto fracture = brittle::fractureFor(scene, engine_test::device());
    EXPECT_TRUE(fracture) << fracture.error().message;
    const auto contents = brittle::contentsOf(scene, {}, fracture->get());
    EXPECT_TRUE(contents) << contents.error().message;
    const auto settings = brittle::settingsOf(scene);
    EXPECT_TRUE(settings);
    auto world = brittle::World::create(engine_test::device(), *contents, *settings, budget);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

void expectAlikeInStepsOfAnyLength(SceneDescription scene, double energy_share, double count_share) {
    std::vector<gpu::BreakEvent> hits;
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        scene.step.dt = dt;
        const auto world = worldOf(scene);
        const auto events = stepUntilItBreaks(*world, 120);
        ASSERT_EQ(events.size(), 1u) << dt;
        hits.push_back(events[0]);
    }
    for (const gpu::BreakEvent& hit : hits) {
        EXPECT_NEAR(hit.blow.z, hits[1].blow.z, energy_share * double{hits[1].blow.z});
        EXPECT_NEAR(hit.made.x, hits[1].made.x, count_share * hits[1].made.x);
    }
}

std::vector<gpu::BodyState> presentBodies(brittle::World& world) {
    const auto states = world.bodies();
    EXPECT_TRUE(states);
    std::vector<gpu::BodyState> present;
    for (const gpu::BodyState& body : *states)
        if ((body.sector.w & BODY_ABSENT) == 0 && body.offset.w != 0) present.push_back(body);
    return present;
}

double massOf(const std::vector<gpu::BodyState>& bodies) {
    double mass = 0;
    for (const gpu::BodyState& body : bodies)
        mass += 1.0 / body.offset.w;
    return mass;
}

void step(brittle::World& world, uint32_t steps) {
    const auto done = world.step(steps);
    ASSERT_TRUE(done) << done.error().message;
}

std::vector<gpu::BreakEvent> stepUntilItBreaks(brittle::World& world, uint32_t most) {
    for (uint32_t k = 0; k < most; ++k) {
        step(world);
        const auto breaks = world.breaks();
        EXPECT_TRUE(breaks);
        if (!breaks->events.empty()) return breaks->events;
    }
    return {};
}

Double3 vectorOf(const gpu::vec4& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

Motion motionOf(const std::vector<gpu::BodyState>& bodies) {
    Motion sum;
    sum.energy = brittle::kineticEnergyOf(bodies);
    for (const gpu::BodyState& body : bodies) {
        const double mass = 1.0 / body.offset.w;
        const Double3 momentum = mass * vectorOf(body.velocity);
        sum.mass += mass;
        sum.momentum = sum.momentum + momentum;
        sum.angular = sum.angular + vectorOf(body.momentum) + brittle::cross(brittle::poseOf(body).place, momentum);
    }
    return sum;
}

double sizeOf(const Double3& v) { return std::sqrt(brittle::dot(v, v)); }

SceneDescription shot(double speed, const char* material) {
    SceneDescription scene = sceneOf({ball({0, 0, 0}, material), ball({-0.6, 0.06, 0}, "")}, false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    scene.bodies[1].velocity = {speed, 0, 0};
    scene.bodies[1].mass = 4;
    return scene;
}

} // namespace breaking_scenes
