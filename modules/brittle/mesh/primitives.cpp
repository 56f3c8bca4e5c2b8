#include "modules/brittle/mesh/primitives.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace brittle {
namespace {

using std::numbers::pi;

engine::Error badName(std::string_view name) {
    return {engine::ErrorCode::BadInput, "no built-in model \"" + std::string(name) + "\"; there are " + builtinNames()};
}

// ---- ring -----------------------------------------------------------------------------------------------------------------

constexpr uint32_t kRingSteps = 160, kSectionSteps = 48, kQuarterTurns = 3;
constexpr double kRingRadius = 1, kSectionRadius = 0.42;

// The section is a square with its corners rounded off: |x|^4 + |y|^4 = 1, at even angles.
std::array<double, 2> sectionPoint(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double radius = kSectionRadius / std::pow(c * c * c * c + s * s * s * s, 0.25);
    return {radius * c, radius * s};
}

Double3 ringPoint(uint32_t step, uint32_t k) {
    const double along = 2 * pi * step / kRingSteps;
    const double twist = kQuarterTurns * pi / 2 * step / kRingSteps;
    const auto [x, y] = sectionPoint(2 * pi * k / kSectionSteps);
    const double out = kRingRadius + x * std::cos(twist) - y * std::sin(twist);
    return {out * std::cos(along), out * std::sin(along), x * std::sin(twist) + y * std::cos(twist)};
}

// The last step meets the first one turned by the twist: the same points under other numbers.
uint32_t ringVertex(uint32_t step, uint32_t k) {
    if (step == kRingSteps) k += kQuarterTurns * kSectionSteps / 4;
    return step % kRingSteps * kSectionSteps + k % kSectionSteps;
}

PolygonCorner ringCorner(uint32_t step, uint32_t k) {
    PolygonCorner corner;
    corner.position = ringVertex(step, k);
    corner.uv = {6 * static_cast<float>(step) / kRingSteps, 2 * static_cast<float>(k) / kSectionSteps};
    return corner;
}

// ---- spheres --------------------------------------------------------------------------------------------------------------

struct Sphere {
    std::vector<Double3> points;
    std::vector<Index3> triangles;
};

Sphere icosahedron() {
    const double g = std::numbers::phi;
    Sphere sphere;
    sphere.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Double3& p : sphere.points)
        p = normalized(p, p);
    sphere.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return sphere;
}

Sphere subdivided(const Sphere& coarse) {
    Sphere fine;
    fine.points = coarse.points;
    std::unordered_map<uint64_t, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const uint64_t edge = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [entry, is_new] = middles.try_emplace(edge, static_cast<uint32_t>(fine.points.size()));
        if (is_new) fine.points.push_back(normalized(coarse.points[a] + coarse.points[b], {0, 0, 1}));
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return fine;
}

Float2 sphereUv(const Double3& p) {
    return {static_cast<float>(0.5 + std::atan2(p[1], p[0]) / (2 * pi)),
            static_cast<float>(std::acos(std::clamp(p[2], -1.0, 1.0)) / pi)};
}

// The radius is given as a function of the direction.
template <class Radius>
ImportedMesh makeSphere(uint32_t level, const Radius& radius) {
    Sphere sphere = icosahedron();
    for (uint32_t k = 0; k < std::min(level, kMaxSphereLevel); ++k)
        sphere = subdivided(sphere);
    MeshBuilder mesh;
    for (const Double3& p : sphere.points)
        mesh.addVertex(radius(p) * p);
    for (const Index3& t : sphere.triangles) {
        std::array<PolygonCorner, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k].position = t[k];
            corners[k].uv = sphereUv(sphere.points[t[k]]);
            // A triangle over the date line goes on to the right instead of all the way back.
            if (k > 0 && corners[k].uv[0] < corners[0].uv[0] - 0.5f) corners[k].uv[0] += 1;
            if (k > 0 && corners[k].uv[0] > corners[0].uv[0] + 0.5f) corners[k].uv[0] -= 1;
        }
        mesh.addPolygon(corners);
    }
    return mesh.take();
}

} // namespace

ImportedMesh makeTwistedRing() {
    MeshBuilder mesh;
    for (uint32_t step = 0; step < kRingSteps; ++step)
        for (uint32_t k = 0; k < kSectionSteps; ++k)
            mesh.addVertex(ringPoint(step, k));
    for (uint32_t step = 0; step < kRingSteps; ++step)
        for (uint32_t k = 0; k < kSectionSteps; ++k) {
            const PolygonCorner a = ringCorner(step, k), b = ringCorner(step + 1, k), c = ringCorner(step + 1, k + 1),
                                d = ringCorner(step, k + 1);
            mesh.addPolygon(std::array{a, b, c});
            mesh.addPolygon(std::array{a, c, d});
        }
    return mesh.take();
}

ImportedMesh makeCube() {
    MeshBuilder mesh;
    for (uint32_t v = 0; v < 8; ++v)
        mesh.addVertex({v & 1 ? 0.5 : -0.5, v & 2 ? 0.5 : -0.5, v & 4 ? 0.5 : -0.5});
    static constexpr std::array<std::array<uint32_t, 4>, 6> kFaces = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    static constexpr std::array<Float2, 4> kUvs = {Float2{0, 1}, Float2{1, 1}, Float2{1, 0}, Float2{0, 0}};
    for (const auto& face : kFaces) {
        std::array<PolygonCorner, 4> corners;
        for (size_t k = 0; k < 4; ++k)
            corners[k] = {face[k], {0, 0, 0}, kUvs[k]};
        mesh.addPolygon(corners);
    }
    return mesh.take();
}

ImportedMesh makeIcosphere(uint32_t level) {
    return makeSphere(level, [](const Double3&) { return 1.0; });
}

ImportedMesh makeBumpySphere(uint32_t level) {
    return makeSphere(level, [](const Double3& p) {
        return 1 + 0.22 * std::sin(5 * p[0] + 0.5) * std::sin(5 * p[1] + 1.1) * std::sin(5 * p[2] + 0.3) +
               0.05 * std::sin(11 * p[0]) * std::cos(9 * p[1] - 0.4);
    });
}

std::string builtinNames() { return "ring, cube, icosphere:LEVEL and bumpy:LEVEL (LEVEL 0 to 8)"; }

engine::Result<ImportedMesh> makeBuiltin(std::string_view name) {
    const size_t colon = name.find(':');
    const std::string_view kind = name.substr(0, colon);
    uint32_t level = 5;
    if (colon != name.npos) {
        const std::string_view digits = name.substr(colon + 1);
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), level);
        if (error != std::errc() || end != digits.data() + digits.size() || level > kMaxSphereLevel) return badName(name);
    }
    if (kind == "icosphere") return makeIcosphere(level);
    if (kind == "bumpy") return makeBumpySphere(level);
    if (kind == "ring" && colon == name.npos) return makeTwistedRing();
    if (kind == "cube" && colon == name.npos) return makeCube();
    return badName(name);
}

} // namespace brittle
