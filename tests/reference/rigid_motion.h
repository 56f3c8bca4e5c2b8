// Rigid bodies that nothing touches, in double precision.
#pragma once

#include "tests/reference/geometry.h"

#include <array>

namespace reference {

using UnitQuaternion = std::array<double, 4>; // x, y, z, w: own frame to world

struct FreeTurning {
    Point moments; // of inertia, about the own axes
    UnitQuaternion turn;
    Point momentum; // angular, in the world: it stays
};

// Spin in the world.
Point spinOf(const FreeTurning& body);

// Where it has turned to, by Runge and Kutta's fourth order in steps that are far smaller than any that matters.
UnitQuaternion turnAfter(const FreeTurning& body, double seconds);

// Of the turn from one to the other, from 0 to pi.
double angleBetween(const UnitQuaternion& a, const UnitQuaternion& b);

} // namespace reference
