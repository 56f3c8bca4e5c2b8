#include "modules/brittle/mesh/components.h"

#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/triangle_shape.h"

#include <algorithm>
#include <numeric>
#include <optional>

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
    // Where the mesh is broken and half-edges have no mate, all that meet at an edge hang together.
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

struct Hit {
    bool is_clear = true; // well inside or well outside the triangle
    double distance = -1; // along the ray, negative for none
    int turn = 0;         // +1 where the ray leaves the solid
};

Hit intersect(const Corners& p, const Double3& origin, const Double3& direction) {
    constexpr double kMargin = 1e-7; // of the triangle: nearer to an edge the neighbor may be hit as well, or neither
    const Double3 normal = doubleArea(p);
    const double facing = dot(normal, direction);
    const Double3 to_plane = p[0] - origin;
    const double scale = dot(normal, normal);
    if (scale == 0) return {};
    if (std::abs(facing) < 1e-7 * std::sqrt(scale)) return {std::abs(dot(normal, to_plane)) > kMargin * scale, -1, 0};
    const double distance = dot(normal, to_plane) / facing;
    const Double3 at = origin + distance * direction;
    double least = HUGE_VAL;
    for (size_t k = 0; k < 3; ++k)
        least = std::min(least, dot(normal, cross(p[(k + 1) % 3] - p[k], at - p[k])) / scale);
    if (least < -kMargin || distance < 0) return {};
    return {least > kMargin, distance, facing > 0 ? 1 : -1};
}

struct Ray {
    uint32_t from = 0; // triangle
    Double3 origin, direction;
};

// Where it lies on another surface nobody can say which of the two is above the other.
struct Layers {
    double nearest = 0; // that count as one
    bool may_lie_on_others = false;
};

std::optional<int> windingAlong(const Mesh& mesh, const TriangleTree& tree, const Ray& ray, const Layers& layers,
                                uint64_t& tests) {
    bool is_clear = true;
    int winding = 0;
    tree.forEachAlong(ray.origin, ray.direction, [&](uint32_t t) {
        ++tests;
        if (t == ray.from) return;
        const Hit hit = intersect(cornersOf(mesh, t), ray.origin, ray.direction);
        is_clear = is_clear && hit.is_clear;
        if (hit.distance >= 0 && hit.distance < layers.nearest)
            is_clear = is_clear && layers.may_lie_on_others;
        else
            winding += hit.turn;
    });
    return is_clear ? std::optional(winding) : std::nullopt;
}

double fraction(double x) { return x - std::floor(x); }

// Spread over the triangle, in odd directions.
Ray rayBelow(const Mesh& mesh, uint32_t triangle, int attempt) {
    const Corners p = cornersOf(mesh, triangle);
    const Double3 normal = normalized(doubleArea(p), {0, 0, 1});
    double u = fraction(0.31 + 0.7549 * attempt), v = fraction(0.37 + 0.5698 * attempt);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const double tilt = 0.071 + 0.037 * attempt;
    const Double3 along = normalized(p[1] - p[0], {1, 0, 0}), across = cross(normal, along);
    return {triangle, p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]),
            normalized(tilt * along + (0.7 * tilt) * across - normal, {0, 0, -1})};
}

} // namespace

std::vector<Component> findComponents(const Mesh& mesh, const MeshTopology& topology) {
    const std::vector<uint32_t> roots = componentRoots(mesh, topology);
    std::vector<uint32_t> number(mesh.triangles.size(), 0);
    std::vector<double> largest;
    std::vector<Component> components;
    for (uint32_t t = 0; t < roots.size(); ++t) {
        if (roots[t] == t) {
            number[t] = static_cast<uint32_t>(components.size());
            components.push_back({t, 0});
            largest.push_back(0);
        }
        const uint32_t c = number[roots[t]];
        const Corners p = cornersOf(mesh, t);
        components[c].volume += dot(p[0], cross(p[1], p[2])) / 6;
        const double area = length(doubleArea(p));
        if (area > largest[c]) components[c].largest_triangle = t;
        largest[c] = std::max(largest[c], area);
    }
    return components;
}

// Rays that graze an edge tell nothing: others are tried from elsewhere on the triangle. One that lies on another surface all
// over, as those of solids that touch, is taken as the upper one.
int windingBelow(const Mesh& mesh, const TriangleTree& tree, uint32_t triangle, double diagonal, uint64_t& tests) {
    const double nearest = 3e-8 * diagonal; // half of a float's last digit
    for (const bool may_lie_on_others : {false, true})
        for (int attempt = 0; attempt < 16; ++attempt) {
            const Ray ray = rayBelow(mesh, triangle, attempt);
            if (const auto winding = windingAlong(mesh, tree, ray, {nearest, may_lie_on_others}, tests)) return *winding;
        }
    return 1;
}

} // namespace brittle
