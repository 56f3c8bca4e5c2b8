// The oracle of free motion, against what is known in closed form.
#include "tests/reference/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using reference::FreeTurning;
using reference::UnitQuaternion;

UnitQuaternion about(size_t axis, double angle) {
    UnitQuaternion q = {0, 0, 0, std::cos(angle / 2)};
    q[axis] = std::sin(angle / 2);
    return q;
}

TEST(RigidMotion, ABodyOnAPrincipalAxisTurnsEvenly) {
    for (size_t axis = 0; axis < 3; ++axis) {
        FreeTurning body = {{2, 3, 4}, {0, 0, 0, 1}, {0, 0, 0}};
        body.momentum[axis] = 5 * body.moments[axis];
        EXPECT_NEAR(reference::spinOf(body)[axis], 5, 1e-12);
        EXPECT_LT(reference::angleBetween(reference::turnAfter(body, 0.3), about(axis, 1.5)), 1e-10);
    }
}

// A top with two equal moments goes around its angular momentum at |L| over the equal moment, and its own axis keeps its angle
// to it.
TEST(RigidMotion, ASymmetricTopPrecessesAsEulerHasIt) {
    const double tilt = 0.7, momentum = 6;
    const FreeTurning body = {{2, 2, 3}, {0, 0, 0, 1}, {momentum * std::sin(tilt), 0, momentum * std::cos(tilt)}};
    const double period = 2 * std::numbers::pi * 2 / momentum;
    const UnitQuaternion q = reference::turnAfter(body, period);
    const double axis_x = 2 * (q[0] * q[2] + q[1] * q[3]), axis_z = 1 - 2 * (q[0] * q[0] + q[1] * q[1]);
    EXPECT_NEAR(axis_x, 0, 1e-9);
    EXPECT_NEAR(axis_z, 1, 1e-9);
    const UnitQuaternion half = reference::turnAfter(body, period / 2);
    const double half_x = 2 * (half[0] * half[2] + half[1] * half[3]), half_z = 1 - 2 * (half[0] * half[0] + half[1] * half[1]);
    EXPECT_NEAR(half_x, std::sin(2 * tilt), 1e-9);
    EXPECT_NEAR(half_z, std::cos(2 * tilt), 1e-9);
}

TEST(RigidMotion, AnglesAreThoseOfTheTurnBetween) {
    EXPECT_NEAR(reference::angleBetween(about(1, 0.2), about(1, 0.5)), 0.3, 1e-12);
    EXPECT_NEAR(reference::angleBetween(about(1, 0), about(1, 2 * std::numbers::pi)), 0, 1e-12);
    EXPECT_NEAR(reference::angleBetween(about(0, 0), about(0, std::numbers::pi)), std::numbers::pi, 1e-9);
}

} // namespace
