// Convex solids in motion, in double precision.
#pragma once

#include "tests/reference/convex.h"

namespace reference {

// The share of `motion` that b has gone when it first touches a, 0 where it does so from the start, infinity where it never
// does: the intervals in which the shadows of the two overlap, on every normal of a face and every cross product of two edges,
// cut with each other.
double impactOf(const Convex& a, const Convex& b, const Point& motion);

} // namespace reference
