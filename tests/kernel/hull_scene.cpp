#include "tests/kernel/hull_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace kernel_test {
namespace {

using reference::cross;
using reference::dot;
using reference::length;
using reference::Point;
using reference::operator+;
using reference::operator-;
using reference::operator*;

struct HalfSpace {
    Point n;
    double height;
};

// Where three planes meet, if they do so at one place.
bool meet(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c, Point& at) {
    const Point bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
    const double volume = dot(a.n, bc);
    if (std::abs(volume) < 1e-9) return false;
    at = (1 / volume) * (a.height * bc + b.height * ca + c.height * ab);
    return true;
}

bool isInside(const std::vector<HalfSpace>& planes, const Point& p) {
    return std::ranges::all_of(planes, [&](const HalfSpace& h) { return dot(h.n, p) < h.height + 1e-9; });
}

Point directionOf(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Point p = {normal(random), normal(random), normal(random)};
    return (1 / length(p)) * p;
}

std::vector<HalfSpace> cellPlanes(std::mt19937& random, uint32_t count) {
    std::uniform_real_distribution<double> height(0.7, 1.0);
    std::vector<HalfSpace> planes;
    for (size_t k = 0; k < 3; ++k) {
        for (const double sign : {-1.0, 1.0}) {
            Point n = {0, 0, 0};
            n[k] = sign;
            planes.push_back({n, 1.2});
        }
    }
    for (uint32_t k = 0; k < count; ++k)
        planes.push_back({directionOf(random), height(random)});
    return planes;
}

// The corners on a plane, counterclockwise seen from outside.
std::vector<uint32_t> loopOn(const HalfSpace& plane, const std::vector<Point>& corners, std::vector<uint32_t> on) {
    const Point u = cross(plane.n, std::abs(plane.n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}), v = cross(plane.n, u);
    Point middle = {0, 0, 0};
    for (const uint32_t k : on)
        middle = middle + (1.0 / static_cast<double>(on.size())) * corners[k];
    std::ranges::sort(on, {}, [&](uint32_t k) { return std::atan2(dot(v, corners[k] - middle), dot(u, corners[k] - middle)); });
    return on;
}

gpu::vec4 wordsOf(const Place& p, double w) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), static_cast<float>(w)};
}

brittle::HullSet hullsOf(const HullScene& scene) {
    brittle::HullSet set;
    for (const Shape& shape : scene.shapes) {
        const auto added = brittle::addHull(set, shape.vertices, shape.loops);
        if (!added) std::fprintf(stderr, "%s\n", added.error().message.c_str());
        ENGINE_ASSERT(added.has_value());
    }
    return set;
}

} // namespace

Turn turnAbout(const Place& axis, double angle) {
    const Point n = (std::sin(angle / 2) / length(axis)) * axis;
    return {n[0], n[1], n[2], std::cos(angle / 2)};
}

Turn after(const Turn& p, const Turn& q) {
    const Point a = {p[0], p[1], p[2]}, b = {q[0], q[1], q[2]};
    const Point v = p[3] * b + q[3] * a + cross(a, b);
    return {v[0], v[1], v[2], p[3] * q[3] - dot(a, b)};
}

Place turned(const Turn& q, const Place& p) {
    const Point v = {q[0], q[1], q[2]}, t = 2.0 * cross(v, p);
    return p + q[3] * t + cross(v, t);
}

Shape boxShape(const Place& half) {
    Shape box;
    for (uint32_t k = 0; k < 8; ++k)
        box.vertices.push_back({static_cast<float>(k & 1 ? half[0] : -half[0]), static_cast<float>(k & 2 ? half[1] : -half[1]),
                                static_cast<float>(k & 4 ? half[2] : -half[2])});
    box.loops = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return box;
}

Shape triangleShape(const Place& a, const Place& b, const Place& c) {
    Shape shape;
    for (const Place& p : {a, b, c})
        shape.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    shape.loops = {{0, 1, 2}, {0, 2, 1}};
    return shape;
}

Shape cellShape(std::mt19937& random, uint32_t count, const Place& stretch) {
    const std::vector<HalfSpace> planes = cellPlanes(random, count);
    std::vector<Point> corners;
    std::vector<std::vector<uint32_t>> on(planes.size());
    Point at;
    for (size_t i = 0; i < planes.size(); ++i)
        for (size_t j = i + 1; j < planes.size(); ++j)
            for (size_t k = j + 1; k < planes.size(); ++k) {
                if (!meet(planes[i], planes[j], planes[k], at) || !isInside(planes, at)) continue;
                for (const size_t plane : {i, j, k})
                    on[plane].push_back(static_cast<uint32_t>(corners.size()));
                corners.push_back(at);
            }
    Shape shape;
    for (size_t k = 0; k < planes.size(); ++k)
        if (!on[k].empty()) shape.loops.push_back(loopOn(planes[k], corners, on[k]));
    for (const Point& p : corners)
        shape.vertices.push_back({static_cast<float>(stretch[0] * p[0]), static_cast<float>(stretch[1] * p[1]),
                                  static_cast<float>(stretch[2] * p[2])});
    return shape;
}

double radiusOf(const Shape& shape) {
    Point middle = {0, 0, 0};
    for (const auto& v : shape.vertices)
        middle = middle + (1.0 / static_cast<double>(shape.vertices.size())) * Point{v[0], v[1], v[2]};
    double radius = 0;
    for (const auto& v : shape.vertices)
        radius = std::max(radius, length(Point{v[0], v[1], v[2]} - middle));
    return radius;
}

uint32_t HullScene::add(const Shape& shape) {
    shapes.push_back(shape);
    return static_cast<uint32_t>(shapes.size() - 1);
}

uint32_t HullScene::addPair(const PlacedShape& a, const PlacedShape& b) {
    const auto first = static_cast<uint32_t>(bodies.size());
    bodies.push_back(a);
    bodies.push_back(b);
    pairs.push_back({first, first + 1});
    return static_cast<uint32_t>(pairs.size() - 1);
}

gpu::BodyState HullScene::stateOf(uint32_t body) const {
    const PlacedShape& placed = bodies[body];
    const Turn& q = placed.turn;
    gpu::BodyState state{};
    state.sector = {placed.sector[0], placed.sector[1], placed.sector[2], 0};
    state.offset = wordsOf(placed.place, placed.inverse_mass);
    state.turn = wordsOf({q[0], q[1], q[2]}, q[3]);
    state.velocity = wordsOf(placed.velocity, 0);
    state.spin = wordsOf(placed.spin, 0);
    return state;
}

reference::Convex HullScene::solidOf(uint32_t body, uint32_t about) const {
    const gpu::BodyState state = stateOf(body);
    const Turn q = {state.turn.x, state.turn.y, state.turn.z, state.turn.w};
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const Shape& shape = shapes[bodies[body].shape];
    Point place = {state.offset.x, state.offset.y, state.offset.z};
    for (size_t k = 0; k < 3; ++k)
        place[k] += SECTOR_EDGE * (bodies[body].sector[k] - bodies[about].sector[k]);
    reference::Convex solid;
    for (const auto& v : shape.vertices)
        solid.vertices.push_back(place + turned({q[0] / size, q[1] / size, q[2] / size, q[3] / size}, {v[0], v[1], v[2]}));
    for (const auto& loop : shape.loops) {
        Point n = {0, 0, 0};
        for (size_t k = 1; k + 1 < loop.size(); ++k)
            n = n +
                cross(solid.vertices[loop[k]] - solid.vertices[loop[0]], solid.vertices[loop[k + 1]] - solid.vertices[loop[0]]);
        n = (1 / length(n)) * n;
        solid.faces.push_back({n, dot(n, solid.vertices[loop[0]]), loop});
    }
    return solid;
}

std::vector<gpu::Manifold> manifoldsOf(const HullScene& scene, const NarrowPhaseRun& run, double* milliseconds) {
    const brittle::HullSet set = hullsOf(scene);
    std::vector<gpu::PieceRecord> pieces;
    std::vector<gpu::BodyState> states;
    for (uint32_t k = 0; k < scene.bodies.size(); ++k) {
        pieces.push_back({{scene.bodies[k].shape, k, 0, 0}});
        states.push_back(scene.stateOf(k));
    }
    const auto count = static_cast<uint32_t>(scene.pairs.size());
    const engine::Buffer records = bufferOf(set.records), vertices = bufferOf(set.vertices), faces = bufferOf(set.faces),
                         corners = bufferOf(set.corners), edges = bufferOf(set.edges), piece = bufferOf(pieces),
                         body = bufferOf(states), pairs = bufferOf(scene.pairs),
                         pair_count = bufferOf(std::vector<uint32_t>{0, 0, count}),
                         manifolds = blankBuffer<gpu::Manifold>(count), axes = blankBuffer<gpu::AxisRecord>(count),
                         arguments = blankBuffer<uint32_t>(8),
                         births = bufferOf(run.births.empty() ? std::vector<gpu::Birth>(1) : run.births),
                         steps = bufferOf(std::vector<uint32_t>{run.steps, 0, 0, 0}),
                         first_hits = bufferOf(std::vector<uint32_t>(4 * scene.bodies.size(), NO_HIT));
    brittle::NarrowPhaseInput input = {{records, vertices, faces, corners, edges}, piece, body, pairs, pair_count, 2, count};
    if (!run.births.empty()) input.siblings = {births, steps};
    if (run.hides) input.first_hits = first_hits;
    engine::KernelLibrary& library = run.kernels ? *run.kernels : kernels();
    const auto start = std::chrono::steady_clock::now();
    onDevice([&](engine::Commands& commands) {
        for (uint32_t k = 0; k < run.repeats; ++k) {
            const auto recorded =
                brittle::recordNarrowPhase(commands, library, input, run.options, {manifolds, axes, arguments}, run.many_lanes);
            EXPECT_TRUE(recorded) << recorded.error().message;
        }
    });
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    if (milliseconds != nullptr) *milliseconds = took.count();
    return valuesOf<gpu::Manifold>(manifolds, count);
}

} // namespace kernel_test
