// The parts of a surface that hang together by edges, and whether they nest as the walls of solids do.
#pragma once

#include "modules/brittle/mesh/triangle_tree.h"

namespace brittle {

struct Component {
    uint32_t largest_triangle = 0;
    double volume = 0; // negative for the wall of a cavity
};

std::vector<Component> findComponents(const Mesh& mesh, const MeshTopology& topology);

// How often the whole surface winds around the point just below the middle of the triangle, on the side its normal points away
// from: 1 wherever the surface bounds a solid, 2 inside a second solid, 0 behind a wall that faces the wrong way.
// 1 also where no answer is to be had. `tests` grows by the triangles looked at: a ray may pass through all of them, so
// callers that ask for every part have to stop somewhere.
int windingBelow(const Mesh& mesh, const TriangleTree& tree, uint32_t triangle, double diagonal, uint64_t& tests);

constexpr uint64_t kMaxNestingTests = 100'000'000;

} // namespace brittle
