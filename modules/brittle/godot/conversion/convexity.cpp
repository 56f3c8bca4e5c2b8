#include "modules/brittle/godot/conversion/convexity.h"

#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace brittle_godot {
namespace {

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Vertices at one place are one.
struct Solid {
    std::vector<Point> points;
    std::vector<uint32_t> corners;
};

Solid solidOf(const Triangles& t) {
    Solid solid;
    std::map<Point, uint32_t> known;
    std::vector<uint32_t> place_of;
    for (size_t k = 0; k < t.vertexCount(); ++k) {
        const Point p = {t.positions[3 * k], t.positions[3 * k + 1], t.positions[3 * k + 2]};
        const auto [at, is_new] = known.try_emplace(p, static_cast<uint32_t>(solid.points.size()));
        if (is_new) solid.points.push_back(p);
        place_of.push_back(at->second);
    }
    for (const uint32_t index : t.indices)
        solid.corners.push_back(place_of.at(index));
    return solid;
}

double sizeOf(const std::vector<Point>& points) {
    double size = 0;
    for (const Point& p : points)
        size = std::max(size, std::sqrt(dot(minus(p, points[0]), minus(p, points[0]))));
    return size;
}

bool isOnePiece(const Solid& solid) {
    std::vector<uint32_t> root(solid.points.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](uint32_t k) {
        while (root[k] != k)
            k = root[k] = root[root[k]];
        return k;
    };
    for (size_t k = 0; k + 2 < solid.corners.size(); k += 3)
        for (const size_t c : {k + 1, k + 2})
            root[find(solid.corners[c])] = find(solid.corners[k]);
    for (const uint32_t corner : solid.corners)
        if (find(corner) != find(solid.corners[0])) return false;
    return true;
}

// The corner across each edge, in the direction in which its triangle has it.
std::map<std::pair<uint32_t, uint32_t>, uint32_t> cornersAcross(const Solid& solid) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> across;
    for (size_t k = 0; k + 2 < solid.corners.size(); k += 3)
        for (size_t c = 0; c < 3; ++c)
            across[{solid.corners[k + c], solid.corners[k + (c + 1) % 3]}] = solid.corners[k + (c + 2) % 3];
    return across;
}

} // namespace

bool isConvex(const Triangles& triangles) {
    constexpr double kFlat = 1e-5; // of the size: what rounding bends
    const Solid solid = solidOf(triangles);
    if (solid.corners.empty() || !isOnePiece(solid)) return false;
    const double slack = kFlat * sizeOf(solid.points);
    const auto across = cornersAcross(solid);
    for (const auto& [edge, corner] : across) {
        const auto other = across.find({edge.second, edge.first});
        if (other == across.end()) return false;
        const Point& a = solid.points[edge.first];
        const Point normal = cross(minus(solid.points[edge.second], a), minus(solid.points[corner], a));
        const double length = std::sqrt(dot(normal, normal));
        if (dot(normal, minus(solid.points[other->second], a)) > slack * length) return false;
    }
    return true;
}

} // namespace brittle_godot
