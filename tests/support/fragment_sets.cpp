#include "tests/support/fragment_sets.h"

#include "tests/support/shapes.h"

namespace support {
namespace {

using brittle::Fragment;
using brittle::FragmentSet;
using brittle::FragmentVertex;
using reference::operator-;
using reference::operator*;

FragmentVertex vertexAt(const reference::Point& p, const reference::Point& normal) {
    FragmentVertex vertex = {};
    for (size_t c = 0; c < 3; ++c) {
        vertex.position[c] = static_cast<float>(p[c]);
        vertex.normal[c] = static_cast<float>(normal[c]);
    }
    vertex.uv[0] = vertex.position[0] + 1;
    vertex.uv[1] = vertex.position[1] - vertex.position[2];
    return vertex;
}

void addTriangle(FragmentSet& set, const Fragment& fragment, const reference::Triangle& t) {
    const reference::Point across = reference::cross(t[1] - t[0], t[2] - t[0]);
    const reference::Point normal = (1 / reference::length(across)) * across;
    for (const reference::Point& p : t) {
        set.indices.push_back(static_cast<uint32_t>(set.vertices.size()) - fragment.first_vertex);
        set.vertices.push_back(vertexAt(p, normal));
    }
}

// `inner_face` of the six, in the order of boxTriangles.
void addBox(FragmentSet& set, const reference::Point& lower, const reference::Point& upper, size_t inner_face,
            const brittle::Double3& site) {
    Fragment fragment;
    fragment.cell = static_cast<uint32_t>(set.fragments.size());
    fragment.first_vertex = static_cast<uint32_t>(set.vertices.size());
    fragment.first_index = static_cast<uint32_t>(set.indices.size());
    fragment.outer_index_count = 30;
    fragment.inner_index_count = 6;
    fragment.vertex_count = 36;
    fragment.site = site;
    fragment.volume = (upper[0] - lower[0]) * (upper[1] - lower[1]) * (upper[2] - lower[2]);
    for (size_t c = 0; c < 3; ++c) {
        fragment.centroid[c] = (lower[c] + upper[c]) / 2;
        fragment.lower[c] = static_cast<float>(lower[c]);
        fragment.upper[c] = static_cast<float>(upper[c]);
    }
    const reference::Triangles triangles = boxTriangles(lower, upper);
    for (const bool inner : {false, true})
        for (size_t t = 0; t < triangles.size(); ++t)
            if ((t / 2 == inner_face) == inner) addTriangle(set, fragment, triangles[t]);
    set.fragments.push_back(fragment);
}

} // namespace

CubeInTwo cubeInTwo() {
    CubeInTwo pieces;
    pieces.sites = {{-0.25, 0, 0}, {0.5, 0, 0}};
    addBox(pieces.set, {-0.5, -0.5, -0.5}, {0.125, 0.5, 0.5}, 1, pieces.sites[0]);
    addBox(pieces.set, {0.125, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0, pieces.sites[1]);
    return pieces;
}

} // namespace support
