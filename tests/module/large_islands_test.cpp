// Tests islands that are too large for one workgroup: their contacts are solved color by color, by kernels of their own. Cubes
// fly against heavy plates in empty space, so momentum and Newton's law of restitution give all velocities.
#include "modules/brittle/dynamics/world.h"
#include "shaders-spirv/shared/solver.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::StepSettings;

constexpr uint32_t kPlates = 56, kCubes = 20; // cubes per plate
constexpr double kEdge = 0.1, kSpeed = 2;     // m, m/s
constexpr double kPlate = 1e6, kCube = 1;     // kg

// Plates side by side, each with rows of cubes that touch it in the first step.
brittle::WorldContents contentsOf(double restitution) {
    brittle::WorldContents contents;
    const auto add = [&](brittle::BodyDefinition body) {
        body.restitution = restitution;
        EXPECT_TRUE(brittle::addBody(contents, body));
    };
    for (uint32_t p = 0; p < kPlates; ++p) {
        const double x = 3 * (p % 8), z = 3 * std::floor(p / 8.0);
        add(support::box({2, 0.5, 2}, {x, -0.25, z}, kPlate / 2));
        for (uint32_t c = 0; c < kCubes; ++c) {
            auto cube =
                support::box({kEdge, kEdge, kEdge}, {x - 0.8 + 0.4 * (c % 5), 0.051, z - 0.6 + 0.4 * std::floor(c / 5.0)},
                             kCube / (kEdge * kEdge * kEdge));
            cube.velocity = {0, -kSpeed, 0};
            add(cube);
        }
    }
    return contents;
}

// Many passes per substep, so that an island is large from 1024 / 64 contacts on.
std::vector<gpu::BodyState> afterTheImpact(double restitution) {
    StepSettings settings;
    settings.gravity = {0, 0, 0};
    settings.iterations = 64;
    settings.substeps = 2;
    static_assert(kPlates * kCubes > FEW_CONTACTS && kCubes > FEW_CONTACTS / 64 && kCubes > WIDE_COLORS);
    auto world = brittle::World::create(engine_test::device(), contentsOf(restitution), settings);
    EXPECT_TRUE(world) << world.error().message;
    EXPECT_TRUE((*world)->step(2));
    EXPECT_EQ((*world)->counts()->contacts, kPlates * kCubes);
    return *(*world)->bodies();
}

// The cubes of a plate leave it with `restitution` of the closing speed.
void expectVelocities(double restitution) {
    const auto bodies = afterTheImpact(restitution);
    ASSERT_EQ(bodies.size(), kPlates * (kCubes + 1));
    const double plate = -kSpeed * kCubes * kCube * (1 + restitution) / (kPlate + kCubes * kCube);
    for (uint32_t k = 0; k < bodies.size(); ++k) {
        const bool is_plate = k % (kCubes + 1) == 0;
        const double expected = plate + (is_plate ? 0 : restitution * kSpeed);
        EXPECT_NEAR(bodies[k].velocity.y, expected, is_plate ? 0.01 * std::abs(plate) : 0.005 * kSpeed) << "body " << k;
        EXPECT_LT(std::hypot(bodies[k].velocity.x, bodies[k].velocity.z), 0.005 * kSpeed) << "body " << k;
        EXPECT_LT(std::hypot(bodies[k].spin.x, bodies[k].spin.y, bodies[k].spin.z), 0.05 * kSpeed) << "body " << k;
    }
}

TEST(LargeIslands, StopWhatDoesNotBounce) { expectVelocities(0); }

TEST(LargeIslands, BounceAsNewtonHasIt) { expectVelocities(0.5); }

} // namespace
