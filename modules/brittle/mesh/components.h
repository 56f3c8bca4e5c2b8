// The parts of a surface that hang together by edges.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <array>

namespace brittle {

constexpr uint32_t kNoTriangle = 0xffffffff;

struct Component {
    double volume = 0; // negative for the wall of a cavity
    uint32_t largest_triangle = 0;
    // The largest triangle of those that face most along +x, -x, +y, -y, +z, -z; kNoTriangle if no triangle does.
    std::array<uint32_t, 6> facing = {kNoTriangle, kNoTriangle, kNoTriangle, kNoTriangle, kNoTriangle, kNoTriangle};
};

struct Components {
    std::vector<uint32_t> of; // of every triangle: its component
    std::vector<Component> all;
};

// Components in the order of their first triangles. Surfaces that touch at an edge of more than two triangles stay apart; where
// half-edges have no mate, all triangles at that edge hang together.
Components findComponents(const Mesh& mesh, const MeshTopology& topology);

// Measures `count` components of which every triangle knows its own.
Components measureComponents(const Mesh& mesh, std::vector<uint32_t> of, uint32_t count);

} // namespace brittle
