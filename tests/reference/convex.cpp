#include "tests/reference/convex.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace reference {
namespace {

using Edges = std::map<std::pair<uint32_t, uint32_t>, int>;

Edges edgesOf(const Convex& solid) {
    Edges edges;
    for (const ConvexFace& face : solid.faces)
        for (size_t k = 0; k < face.loop.size(); ++k)
            ++edges[{face.loop[k], face.loop[(k + 1) % face.loop.size()]}];
    return edges;
}

std::string closureDefect(const Convex& solid) {
    const Edges edges = edgesOf(solid);
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (count != 1 || back == edges.end() || back->second != 1)
            return "edge " + std::to_string(edge.first) + "-" + std::to_string(edge.second) + " is not shared by two faces";
    }
    std::set<uint32_t> used;
    for (const auto& [edge, count] : edges)
        used.insert(edge.first);
    if (used.size() != solid.vertices.size()) return "a vertex is in no face";
    if (2 * (used.size() + solid.faces.size()) != edges.size() + 4) return "it is no sphere";
    return "";
}

Point areaVector(const Convex& solid, const ConvexFace& face) {
    Point sum = {0, 0, 0};
    const Point& a = solid.vertices[face.loop[0]];
    for (size_t k = 1; k + 1 < face.loop.size(); ++k)
        sum = sum + cross(solid.vertices[face.loop[k]] - a, solid.vertices[face.loop[k + 1]] - a);
    return 0.5 * sum;
}

double perimeter(const Convex& solid, const ConvexFace& face) {
    double sum = 0;
    for (size_t k = 0; k < face.loop.size(); ++k)
        sum += length(solid.vertices[face.loop[(k + 1) % face.loop.size()]] - solid.vertices[face.loop[k]]);
    return sum;
}

std::string faceDefect(const Convex& solid, const ConvexFace& face, double tolerance) {
    if (face.loop.size() < 3) return "a face has less than three corners";
    if (std::fabs(length(face.normal) - 1) > 1e-6) return "a normal is not of unit length";
    for (uint32_t v : face.loop)
        if (std::fabs(dot(face.normal, solid.vertices[v]) - face.height) > tolerance)
            return "a corner is not in its face's plane";
    // Rounding turns a sliver over by no more area than its rim is long, times the tolerance.
    if (dot(areaVector(solid, face), face.normal) < -tolerance * perimeter(solid, face)) return "a face is turned over";
    for (const Point& p : solid.vertices)
        if (dot(face.normal, p) - face.height > tolerance) return "a vertex lies beyond a face";
    return "";
}

std::pair<double, double> rangeOf(const Convex& solid, const Point& axis) {
    std::pair<double, double> range = {1e300, -1e300};
    for (const Point& p : solid.vertices) {
        range.first = std::min(range.first, dot(axis, p));
        range.second = std::max(range.second, dot(axis, p));
    }
    return range;
}

double overlapAlong(const Convex& a, const Convex& b, const Point& axis) {
    const auto [a_low, a_high] = rangeOf(a, axis);
    const auto [b_low, b_high] = rangeOf(b, axis);
    return std::min(a_high - b_low, b_high - a_low);
}

std::vector<Point> directionsOf(const Convex& solid) {
    std::vector<Point> directions;
    for (const auto& [edge, count] : edgesOf(solid))
        if (edge.first < edge.second) directions.push_back(solid.vertices[edge.second] - solid.vertices[edge.first]);
    return directions;
}

} // namespace

std::string defectOf(const Convex& solid, double tolerance) {
    if (solid.faces.size() < 4) return "it has less than four faces";
    for (const ConvexFace& face : solid.faces)
        if (std::string defect = faceDefect(solid, face, tolerance); !defect.empty()) return defect;
    return closureDefect(solid);
}

double volumeOf(const Convex& solid) {
    Triangles triangles;
    for (const ConvexFace& face : solid.faces)
        for (size_t k = 1; k + 1 < face.loop.size(); ++k)
            triangles.push_back({solid.vertices[face.loop[0]], solid.vertices[face.loop[k]], solid.vertices[face.loop[k + 1]]});
    return volumeOf(triangles);
}

double distanceOutside(const Convex& solid, const Point& p) {
    double distance = 0;
    for (const ConvexFace& face : solid.faces)
        distance = std::max(distance, dot(face.normal, p) - face.height);
    return distance;
}

double overlapOf(const Convex& a, const Convex& b) {
    double least = 1e300;
    for (const Convex* solid : {&a, &b})
        for (const ConvexFace& face : solid->faces)
            least = std::min(least, overlapAlong(a, b, face.normal));
    if (least <= 0) return least;
    for (const Point& u : directionsOf(a)) {
        for (const Point& w : directionsOf(b)) {
            const Point axis = cross(u, w);
            const double size = length(axis);
            if (size > 1e-6 * length(u) * length(w)) least = std::min(least, overlapAlong(a, b, (1 / size) * axis));
        }
    }
    return least;
}

} // namespace reference
