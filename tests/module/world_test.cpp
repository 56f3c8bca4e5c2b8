// Worlds of a few bodies: what every engineer can work out on paper.
#include "modules/brittle/dynamics/world.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::BodyDefinition;
using brittle::Double3;
using brittle::StepSettings;
using brittle::World;
using brittle::WorldContents;

std::unique_ptr<World> worldOf(const std::vector<BodyDefinition>& bodies, const StepSettings& settings = {}) {
    WorldContents contents;
    for (const BodyDefinition& body : bodies) {
        const auto added = brittle::addBody(contents, body);
        EXPECT_TRUE(added) << added.error().message;
    }
    auto world = World::create(engine_test::device(), contents, settings);
    if (!world) {
        ADD_FAILURE() << world.error().message;
        return nullptr;
    }
    return std::move(*world);
}

void run(World& world, uint32_t steps) {
    const auto done = world.step(steps);
    ASSERT_TRUE(done) << done.error().message;
}

Double3 placeOf(const gpu::BodyState& b) {
    return {16.0 * b.sector.x + b.offset.x, 16.0 * b.sector.y + b.offset.y, 16.0 * b.sector.z + b.offset.z};
}

std::vector<gpu::BodyState> bodiesOf(World& world) {
    auto bodies = world.bodies();
    EXPECT_TRUE(bodies);
    return bodies ? *bodies : std::vector<gpu::BodyState>();
}

// Symplectic Euler in substeps: after n of them the way is g h^2 n (n + 1) / 2.
TEST(SmallWorld, ABodyFallsAsGravityHasIt) {
    auto world = worldOf({support::box({1, 1, 1}, {3, 100, -20})});
    run(*world, 60);
    const gpu::BodyState body = bodiesOf(*world).at(0);
    const double h = 1.0 / 240, fallen = 9.81 * h * h * 240 * 241 / 2;
    EXPECT_NEAR(placeOf(body)[1], 100 - fallen, 1e-4);
    EXPECT_NEAR(body.velocity.y, -9.81, 1e-4);
    EXPECT_EQ(placeOf(body)[0], 3);
    EXPECT_EQ(placeOf(body)[2], -20);
}

TEST(SmallWorld, ABoxRestsOnTheGround) {
    auto world = worldOf({support::ground(), support::box({1, 1, 1}, {0, 0.5, 0})});
    run(*world, 120);
    const gpu::BodyState body = bodiesOf(*world).at(1);
    EXPECT_NEAR(placeOf(body)[1], 0.5, 2e-3);
    EXPECT_NEAR(placeOf(body)[0], 0, 1e-4);
    EXPECT_LT(std::fabs(body.velocity.y), 1e-4);
    const auto counts = world->counts();
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->contacts, 1u);
}

TEST(World, AStackOfTenCubesStands) {
    std::vector<BodyDefinition> bodies = {support::ground()};
    for (int k = 0; k < 10; ++k)
        bodies.push_back(support::box({1, 1, 1}, {0, 0.5 + k, 0}));
    auto world = worldOf(bodies);
    run(*world, 900);
    const gpu::BodyState top = bodiesOf(*world).back();
    EXPECT_LE(std::hypot(placeOf(top)[0], placeOf(top)[2]), 1e-3);
}

} // namespace
