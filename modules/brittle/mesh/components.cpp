#include "modules/brittle/mesh/components.h"

#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <numeric>

namespace brittle {
namespace {

std::vector<uint32_t> componentRoots(const Mesh& mesh, const MeshTopology& topology) {
    std::vector<uint32_t> parent(mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t t) {
        while (parent[t] != t)
            t = parent[t] = parent[parent[t]];
        return t;
    };
    std::vector<uint32_t> first_unpaired(topology.edges.size(), kNoMate);
    for (uint32_t h = 0; h < topology.half_edge_mates.size(); ++h) {
        uint32_t other = topology.half_edge_mates[h];
        uint32_t& first = first_unpaired[topology.triangle_edges[h / 3][h % 3]];
        if (other == kNoMate) other = first == kNoMate ? (first = h) : first;
        const uint32_t a = root(h / 3), b = root(other / 3);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (uint32_t t = 0; t < parent.size(); ++t)
        parent[t] = root(t);
    return parent;
}

// 0 to 5: the direction among +x, -x, +y, -y, +z, -z that is nearest to the normal.
size_t directionOf(const Double3& normal) {
    size_t axis = 0;
    for (size_t k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

} // namespace

Components measureComponents(const Mesh& mesh, std::vector<uint32_t> of, uint32_t count) {
    Components components{std::move(of), std::vector<Component>(count)};
    std::vector<std::array<double, 6>> areas(count, std::array<double, 6>{-1, -1, -1, -1, -1, -1});
    std::vector<double> largest(count, -1);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const uint32_t c = components.of[t];
        Component& component = components.all[c];
        const Corners p = cornersOf(mesh, t);
        const Double3 normal = doubleArea(p);
        const double area = length(normal);
        const size_t direction = directionOf(normal);
        component.volume += dot(p[0], cross(p[1], p[2])) / 6;
        if (area > largest[c]) component.largest_triangle = t;
        if (area > areas[c][direction]) component.facing[direction] = t;
        largest[c] = std::max(largest[c], area);
        areas[c][direction] = std::max(areas[c][direction], area);
    }
    return components;
}

Components findComponents(const Mesh& mesh, const MeshTopology& topology) {
    std::vector<uint32_t> of = componentRoots(mesh, topology);
    uint32_t count = 0;
    for (uint32_t t = 0; t < of.size(); ++t) // a root comes before all others of its component
        of[t] = of[t] == t ? count++ : of[of[t]];
    return measureComponents(mesh, std::move(of), count);
}

} // namespace brittle
