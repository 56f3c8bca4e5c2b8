// A blow that a host gives by hand: of each body that it reaches as if it had met, at its nearest place, a ball of that radius, as
// dense as the body, that does not give way, with that energy between the two along the line on which they meet.
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
