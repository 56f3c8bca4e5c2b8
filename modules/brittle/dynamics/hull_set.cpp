#include "modules/brittle/dynamics/hull_set.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

namespace brittle {
namespace {

using engine::Error;
using engine::ErrorCode;
using engine::Result;
using Loops = std::span<const std::vector<uint32_t>>;
using EdgeSides = std::map<std::array<uint32_t, 2>, uint32_t>; // directed edge to the face on whose loop it runs

constexpr double kBulge = 1e-3; // of the radius
constexpr double kFlat = 1e-5;  // likewise: what rounding alone may do to a face that is no sliver

float narrow(double x) { return static_cast<float>(x); }

Error refuse(const std::string& why) {
    return {ErrorCode::BadInput, "this is no hull: " + why + "; give a closed convex surface of at least two faces"};
}

Result<void> checkSizes(std::span<const Float3> vertices, Loops loops) {
    size_t corners = 0;
    for (const auto& loop : loops)
        corners += loop.size();
    const auto over = [](const char* what, size_t count, size_t limit) {
        return Error{ErrorCode::Capacity, "a hull has " + std::to_string(count) + " " + what + ", the most is " +
                                              std::to_string(limit) + "; give it fewer or split it"};
    };
    if (vertices.size() > HULL_VERTICES) return over("vertices", vertices.size(), HULL_VERTICES);
    if (loops.size() > HULL_FACES) return over("faces", loops.size(), HULL_FACES);
    if (corners > 2 * HULL_EDGES) return over("edges", corners / 2, HULL_EDGES);
    if (vertices.size() < 3 || loops.size() < 2) return refuse("it has less than three vertices or two faces");
    for (const Float3& v : vertices)
        if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || !std::isfinite(v[2])) return refuse("a coordinate is not a number");
    return {};
}

Result<EdgeSides> sidesOf(std::span<const Float3> vertices, Loops loops) {
    EdgeSides sides;
    for (uint32_t f = 0; f < loops.size(); ++f) {
        if (loops[f].size() < 3) return refuse("face " + std::to_string(f) + " has less than three corners");
        for (size_t c = 0; c < loops[f].size(); ++c) {
            const uint32_t from = loops[f][c], to = loops[f][(c + 1) % loops[f].size()];
            if (from >= vertices.size()) return refuse("face " + std::to_string(f) + " names a vertex that is not there");
            if (!sides.emplace(std::array{from, to}, f).second) return refuse("two faces run along an edge the same way");
        }
    }
    for (const auto& [edge, face] : sides)
        if (!sides.contains({edge[1], edge[0]})) return refuse("face " + std::to_string(face) + " has an open edge");
    return sides;
}

// Its center is the mean of its vertices, which lies inside.
gpu::vec4 ballOf(std::span<const Float3> vertices) {
    Double3 mean = {0, 0, 0};
    for (const Float3& v : vertices)
        for (size_t k = 0; k < 3; ++k)
            mean[k] += static_cast<double>(v[k]) / static_cast<double>(vertices.size());
    gpu::vec4 ball = {narrow(mean[0]), narrow(mean[1]), narrow(mean[2]), 0};
    double radius = 0;
    for (const Float3& v : vertices)
        radius = std::max(radius, std::hypot(double(v[0]) - ball.x, double(v[1]) - ball.y, double(v[2]) - ball.z));
    ball.w = narrow(radius * (1 + 1e-6));
    return ball;
}

// By Newell's method. No direction where the loop has no area.
Double3 normalOf(std::span<const Float3> vertices, const std::vector<uint32_t>& loop) {
    const Double3 base = toDouble(vertices[loop[0]]);
    Double3 n = {0, 0, 0};
    for (size_t c = 0; c < loop.size(); ++c)
        n += cross(toDouble(vertices[loop[c]]) - base, toDouble(vertices[loop[(c + 1) % loop.size()]]) - base);
    return normalized(n, {0, 0, 0});
}

// Through the middle of the corners' heights.
gpu::vec4 planeOf(std::span<const Float3> vertices, const std::vector<uint32_t>& loop, const Double3& n) {
    double low = dot(n, toDouble(vertices[loop[0]])), high = low;
    for (const uint32_t c : loop) {
        low = std::min(low, dot(n, toDouble(vertices[c])));
        high = std::max(high, dot(n, toDouble(vertices[c])));
    }
    return {narrow(n[0]), narrow(n[1]), narrow(n[2]), narrow((low + high) / 2)};
}

bool isPlane(const gpu::vec4& plane) { return plane.x != 0 || plane.y != 0 || plane.z != 0; }

// How far vertices lie beyond.
double bulgeOf(std::span<const Float3> vertices, const gpu::vec4& plane) {
    double bulge = 0;
    for (const Float3& v : vertices)
        bulge = std::max(bulge, dot({plane.x, plane.y, plane.z}, toDouble(v)) - plane.w);
    return bulge;
}

// The loop's own, unless the given normal makes a better one: corners of a sliver lie across it as they were rounded.
gpu::vec4 betterPlane(std::span<const Float3> vertices, const std::vector<uint32_t>& loop, const Double3& given,
                      double radius) {
    const gpu::vec4 own = planeOf(vertices, loop, normalOf(vertices, loop)), other = planeOf(vertices, loop, given);
    const double bulge = bulgeOf(vertices, own);
    if (isPlane(own) && bulge <= kFlat * radius) return own;
    return !isPlane(own) || bulgeOf(vertices, other) < bulge ? other : own;
}

Result<std::vector<gpu::vec4>> planesOf(std::span<const Float3> vertices, Loops loops, std::span<const Float3> normals,
                                        double radius) {
    std::vector<gpu::vec4> planes;
    for (size_t f = 0; f < loops.size(); ++f) {
        planes.push_back(normals.empty() ? planeOf(vertices, loops[f], normalOf(vertices, loops[f]))
                                         : betterPlane(vertices, loops[f], toDouble(normals[f]), radius));
        if (!isPlane(planes[f])) return refuse("face " + std::to_string(f) + " has no area");
        if (bulgeOf(vertices, planes[f]) > kBulge * radius) return refuse("a vertex lies beyond face " + std::to_string(f));
    }
    return planes;
}

gpu::HullRecord recordOf(const HullSet& set, std::span<const Float3> vertices, Loops loops, const EdgeSides& sides) {
    const auto size = [](const auto& pool) { return static_cast<uint32_t>(pool.size()); };
    const auto corners = static_cast<uint32_t>(sides.size());
    return {{size(set.vertices), size(set.faces), size(set.corners), size(set.edges)},
            {size(vertices), size(loops), corners, corners / 2},
            ballOf(vertices)};
}

} // namespace

Result<uint32_t> addHull(HullSet& set, std::span<const Float3> vertices, Loops loops, std::span<const Float3> normals,
                         uint32_t hidden_sides) {
    if (!normals.empty() && normals.size() != loops.size()) return refuse("it has other normals than faces");
    if (auto sizes = checkSizes(vertices, loops); !sizes) return sizes.error();
    const auto sides = sidesOf(vertices, loops);
    if (!sides) return sides.error();
    const gpu::HullRecord record = recordOf(set, vertices, loops, *sides);
    const auto planes = planesOf(vertices, loops, normals, record.center.w);
    if (!planes) return planes.error();

    for (const Float3& v : vertices)
        set.vertices.push_back({v[0], v[1], v[2], 0});
    for (size_t f = 0; f < loops.size(); ++f) {
        const auto first = static_cast<uint32_t>(set.corners.size());
        set.faces.push_back({(*planes)[f], {first, static_cast<uint32_t>(loops[f].size()), hidden_sides, 0}});
        set.corners.insert(set.corners.end(), loops[f].begin(), loops[f].end());
    }
    for (const auto& [edge, face] : *sides)
        if (edge[0] < edge[1]) set.edges.push_back({edge[0], edge[1], face, sides->at({edge[1], edge[0]})});
    set.records.push_back(record);
    return static_cast<uint32_t>(set.records.size() - 1);
}

} // namespace brittle
