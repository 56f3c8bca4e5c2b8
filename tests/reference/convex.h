// Convex polyhedra in double precision: whether they are what they should be, and whether two of them overlap.
#pragma once

#include "tests/reference/geometry.h"

#include <string>

namespace reference {

struct ConvexFace {
    Point normal; // outward, unit
    double height = 0;
    std::vector<uint32_t> loop; // counter-clockwise seen from outside
};

struct Convex {
    std::vector<Point> vertices;
    std::vector<ConvexFace> faces;
};

// Empty where every edge is walked once each way, V - E + F = 2, every loop lies in its plane and turns the way its normal
// says, and every vertex lies behind every plane, all lengths to `tolerance`; else what is wrong, in words.
std::string defectOf(const Convex& solid, double tolerance);

double volumeOf(const Convex& solid);

// By how much the point lies outside, 0 inside.
double distanceOutside(const Convex& solid, const Point& p);

// How deep two solids lie in each other at least: the smallest overlap along any normal of a face or cross product of two
// edges; not positive where they are apart or touch (the separating axis theorem).
double overlapOf(const Convex& a, const Convex& b);

} // namespace reference
