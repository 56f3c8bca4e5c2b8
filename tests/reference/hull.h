// Convex hulls by trying every plane through three points, and what solids weigh by sampling tetrahedra.
#pragma once

#include "tests/reference/convex.h"

#include <array>
#include <span>

namespace reference {

// Every plane through three of the points that has all others behind it, with the points that lie in it to `flat`; once each.
// Time grows with the fourth power of the number of points. The vertices are the points themselves, also those within.
Convex hullByBruteForce(std::span<const Point> points, double flat);

struct Weight {
    double volume = 0;
    Point center = {0, 0, 0};
    std::array<double, 6> inertia = {}; // about the center, of density 1: xx, yy, zz, xy, xz, yz
};

// Every face a fan of triangles, each the floor of a tetrahedron under the first vertex, of which four points at a quarter of
// the volume each give all that is quadratic in the place exactly (Keast 1986, the rule of four points).
Weight weightOf(const Convex& solid);

} // namespace reference
