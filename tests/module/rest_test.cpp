// Tests when bodies fall asleep: boxes that slide over the ground without friction keep the speed that they begin with.
#include "modules/brittle/dynamics/world.h"
#include "tests/engine/test_device.h"
#include "tests/support/rigid_bodies.h"

#include <gtest/gtest.h>

namespace {

constexpr uint32_t kMost = 90; // steps

// Steps until a cube of this edge sleeps that slides this fast; kMost if it never does.
uint32_t stepsUntilAsleep(double edge, double speed, double sleep_after) {
    brittle::StepSettings settings;
    settings.sleeping = true;
    settings.friction = false;
    settings.sleep_speed = 0.05;
    settings.sleep_after = sleep_after;
    brittle::WorldContents contents;
    auto cube = support::box({edge, edge, edge}, {0, edge / 2, 0});
    cube.velocity = {speed, 0, 0};
    EXPECT_TRUE(brittle::addBody(contents, cube));
    EXPECT_TRUE(brittle::addBody(contents, support::ground()));
    auto world = brittle::World::create(engine_test::device(), contents, settings);
    EXPECT_TRUE(world) << world.error().message;
    for (uint32_t k = 0; k < kMost; ++k) {
        EXPECT_TRUE((*world)->step());
        if (((*(*world)->bodies())[0].sector.w & BODY_ASLEEP) != 0) return k + 1;
    }
    return kMost;
}

TEST(Rest, LastsAsLongAsTheSettingsSayBeforeABodySleeps) {
    for (const double seconds : {0.25, 0.5, 1.0}) {
        const uint32_t steps = stepsUntilAsleep(1, 0, seconds);
        EXPECT_GE(steps, 60 * seconds);
        EXPECT_LE(steps, 60 * seconds + 5) << "a few steps until its contacts bear it";
    }
}

TEST(Rest, OfALargeBodyIsSlowerThanTheSpeedOfSleep) {
    EXPECT_LT(stepsUntilAsleep(1, 0.045, 0.5), kMost);
    EXPECT_EQ(stepsUntilAsleep(1, 0.055, 0.5), kMost);
}

// Half the diagonal of a cube of 0.1 m is 0.0866 m.
TEST(Rest, OfASmallBodyIsSlowerThanATenthOfItsRadiusPerSecond) {
    EXPECT_LT(stepsUntilAsleep(0.1, 0.0078, 0.5), kMost);
    EXPECT_EQ(stepsUntilAsleep(0.1, 0.0096, 0.5), kMost);
}

} // namespace
