// A blow that a host gives by hand.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

namespace brittle {

struct HandBlow {
    Double3 place = {0, 0, 0}; // world, m
    // m: bodies that are no further away are struck, each at its nearest place; and how wide the contact is.
    double radius = 0.05;
    double energy = 1; // J, shared evenly among all that are struck
};

// Errors: BadInput for what is no number, a place beyond 1e6 m, a radius or an energy that is not above 0 and at most 1e6 m,
// 1e15 J.
engine::Result<void> checkBlow(const HandBlow& blow);

} // namespace brittle
