// What the bench measures on: made by code, the same for us and for every peer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bench {

using Point = std::array<double, 3>;

struct Model {
    std::vector<Point> vertices;
    std::vector<std::array<uint32_t, 3>> triangles; // counter-clockwise seen from outside
};

// A convex ball within the unit box: 20 * 4^level triangles. The coordinates are floats.
Model smoothSphere(uint32_t level);

// A closed ball with bumps and dents, not convex, within the unit box: 20 * 4^level triangles. The coordinates are floats.
Model bumpySphere(uint32_t level);

Model unitCube();

// Uniform in the unit box.
std::vector<Point> uniformSites(uint32_t count, uint64_t seed);

} // namespace bench
