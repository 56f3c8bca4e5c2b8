// The outcome of one fracture event, read back from the scene buffers.
#pragma once

#include "modules/brittle/collision/collider.h"
#include "modules/brittle/mesh/vector_math.h"

#include <array>
#include <cstdint>
#include <vector>

namespace brittle {

struct FragmentVertex {
    float position[3]; // relative to FragmentSet::center
    float normal[3];
    float uv[2];
};
static_assert(sizeof(FragmentVertex) == 32);
inline Double3 positionOf(const FragmentVertex& v) { return toDouble({v.position[0], v.position[1], v.position[2]}); }

struct Fragment {
    uint32_t cell = 0;         // index of its site among the sites used
    uint32_t first_vertex = 0; // added to every index, as vertexOffset of a draw command
    uint32_t vertex_count = 0;
    uint32_t first_index = 0;         // outer triangles first, inner ones after them
    uint32_t outer_index_count = 0;   // on the surface of what was broken
    uint32_t earlier_index_count = 0; // of those, the last: on faces of earlier cuts, to be drawn as inner ones
    uint32_t inner_index_count = 0;   // on faces cut now, shared with other fragments
    Double3 site = {0, 0, 0};         // model space
    double volume = 0;
    Double3 centroid = {0, 0, 0}; // relative to FragmentSet::center
    // Of inertia about the centroid, for a density of 1: xx yy zz xy xz yz of the tensor, model units to the fifth.
    std::array<double, 6> inertia = {0, 0, 0, 0, 0, 0};
    Float3 lower = {0, 0, 0}; // bounds, relative to FragmentSet::center
    Float3 upper = {0, 0, 0};
};

struct FragmentSet {
    Double3 center = {0, 0, 0};
    std::vector<FragmentVertex> vertices;
    std::vector<uint32_t> indices; // relative to the fragment's first_vertex
    std::vector<Fragment> fragments;
    ColliderSet colliders; // where they were asked for
};

} // namespace brittle
