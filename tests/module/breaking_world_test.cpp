// Worlds in which bodies break: where they are hit, as hard as they are hit, without the host.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::SceneDescription, brittle::BodyDescription, brittle::ColliderDescription;

constexpr double kBall = 0.1; // m

BodyDescription ball(brittle::Double3 place, const char* material) {
    BodyDescription body;
    body.shape.kind = brittle::ShapeKind::Ball;
    body.shape.radius = kBall;
    body.place = place;
    body.material = material;
    return body;
}

SceneDescription sceneOf(std::vector<BodyDescription> bodies, bool floor = true) {
    SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction", "impact_fracture"};
    scene.bodies = std::move(bodies);
    if (floor) scene.colliders.push_back({});
    return scene;
}

std::unique_ptr<brittle::World> worldOf(const SceneDescription& scene) {
    const auto contents = brittle::contentsOf(scene, {}, nullptr);
    EXPECT_TRUE(contents) << contents.error().message;
    const auto settings = brittle::settingsOf(scene);
    EXPECT_TRUE(settings);
    auto world = brittle::World::create(engine_test::device(), *contents, *settings);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
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

TEST(BreakingWorld, ABallOfGlassThatFallsFromHighUpBreaks) {
    const auto world = worldOf(sceneOf({ball({0, 3, 0}, "glass")}));
    const double mass = massOf(presentBodies(*world));
    for (uint32_t step = 0; step < 60 && presentBodies(*world).size() == 1; ++step) {
        const auto done = world->step();
        ASSERT_TRUE(done) << done.error().message;
    }
    const auto fragments = presentBodies(*world);
    EXPECT_GT(fragments.size(), 2u);
    EXPECT_NEAR(massOf(fragments), mass, 1e-6 * mass);
    for (uint32_t step = 0; step < 60; ++step) {
        const auto done = world->step();
        ASSERT_TRUE(done) << done.error().message;
    }
    for (const gpu::BodyState& body : presentBodies(*world)) {
        const brittle::Double3 place = brittle::poseOf(body).place;
        EXPECT_GT(place[1], -0.01);
        EXPECT_LT(std::hypot(place[0], place[2]), 30);
    }
    EXPECT_NEAR(massOf(presentBodies(*world)), mass, 1e-6 * mass);
}

TEST(BreakingWorld, ABallThatIsSetDownDoesNotBreak) {
    const auto world = worldOf(sceneOf({ball({0, kBall + 0.001, 0}, "glass")}));
    const auto done = world->step(30);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(presentBodies(*world).size(), 1u);
}

} // namespace
