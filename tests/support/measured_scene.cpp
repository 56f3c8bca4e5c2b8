#include "tests/support/measured_scene.h"

#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/world_mover.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace support {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*, brittle::operator+=;

bool hasCells(const brittle::SceneDescription& scene) {
    return std::ranges::any_of(scene.bodies, [](const brittle::BodyDescription& b) { return b.shape.cells.sites != 0; });
}

Double3 vectorOf(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

double sizeOf(const Double3& v) { return std::sqrt(brittle::dot(v, v)); }

// By so many radians about its own direction (Rodrigues).
Double3 turnedBySpin(const Double3& v, const Double3& angles) {
    const double angle = sizeOf(angles);
    if (angle == 0) return v;
    const Double3 axis = (1 / angle) * angles;
    return std::cos(angle) * v + std::sin(angle) * brittle::cross(axis, v) +
           ((1 - std::cos(angle)) * brittle::dot(axis, v)) * axis;
}

// How far the arcs of a hull's points lead beyond their chords, at most.
double bulgeOf(const gpu::HullRecord& hull, double angle) {
    return (sizeOf(vectorOf(hull.center)) + hull.center.w) * (1 - std::cos(std::min(angle, 2 * std::numbers::pi) / 2));
}

} // namespace

double marginOf(const brittle::StepDescription& step) {
    const double sixtieths = 60 * step.dt;
    return step.margin > 0 ? step.margin : 0.02 * sixtieths * sixtieths;
}

engine::Result<void> MeasuredScene::make(engine::Device& device, const MakeMover& make_mover) {
    std::unique_ptr<brittle::Fracture> fracture;
    if (hasCells(scene_)) {
        auto made = brittle::Fracture::create(device);
        if (!made) return made.error();
        fracture = std::move(*made);
    }
    auto contents = brittle::contentsOf(scene_, ".", fracture.get());
    if (!contents) return contents.error();
    contents_ = std::move(*contents);
    first_ = last_ = now_ = contents_.bodies;
    if (!make_mover) return makeWorld(device);
    auto mover = make_mover(scene_, contents_);
    if (!mover) return mover.error();
    mover_ = std::move(*mover);
    return {};
}

engine::Result<void> MeasuredScene::makeWorld(engine::Device& device) {
    auto mover = WorldMover::make(device, scene_, contents_);
    if (!mover) return mover.error();
    world_ = &(*mover)->world();
    mover_ = std::move(*mover);
    return {};
}

engine::Result<void> MeasuredScene::advance(uint32_t steps) {
    if (auto done = mover_->step(steps); !done) return done;
    auto bodies = mover_->bodies();
    if (!bodies) return bodies.error();
    last_ = std::exchange(now_, std::move(*bodies));
    made_ += steps;
    return {};
}

Double3 MeasuredScene::place(size_t body) const { return poseOf(now_[body]).place; }
Double3 MeasuredScene::way(size_t body) const { return poseOf(now_[body]).place - poseOf(first_[body]).place; }
double MeasuredScene::speed(size_t body) const { return sizeOf(vectorOf(now_[body].velocity)); }

double MeasuredScene::fastest() const {
    double most = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) most = std::max(most, speed(b));
    return most;
}

double MeasuredScene::furthestWay() const {
    double most = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) most = std::max(most, sizeOf(way(b)));
    return most;
}

double MeasuredScene::meanWay() const {
    double sum = 0, moving = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) {
            sum += sizeOf(way(b));
            ++moving;
        }
    return moving == 0 ? 0 : sum / moving;
}

double MeasuredScene::kineticEnergy(size_t b) const {
    return 0.5 * speed(b) * speed(b) / now_[b].offset.w +
           0.5 * brittle::dot(vectorOf(now_[b].momentum), vectorOf(now_[b].spin));
}

double MeasuredScene::kineticEnergy() const {
    double sum = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) sum += kineticEnergy(b);
    return sum;
}

Double3 MeasuredScene::momentum() const {
    Double3 sum = {0, 0, 0};
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) sum += (1.0 / now_[b].offset.w) * vectorOf(now_[b].velocity);
    return sum;
}

double MeasuredScene::momentumInAll() const {
    double sum = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) sum += speed(b) / now_[b].offset.w;
    return sum;
}

double MeasuredScene::angularMomentumInAll() const {
    double sum = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b))
            sum += sizeOf(vectorOf(now_[b].momentum) +
                          (1.0 / now_[b].offset.w) * brittle::cross(place(b), vectorOf(now_[b].velocity)));
    return sum;
}

Double3 MeasuredScene::angularMomentum() const {
    Double3 sum = {0, 0, 0};
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b))
            sum += vectorOf(now_[b].momentum) + (1.0 / now_[b].offset.w) * brittle::cross(place(b), vectorOf(now_[b].velocity));
    return sum;
}

bool MeasuredScene::isFinite() const {
    return std::ranges::all_of(now_, [](const gpu::BodyState& b) {
        const auto finite = [](const gpu::vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
        return finite(b.offset) && finite(b.turn) && finite(b.velocity) && finite(b.spin) && finite(b.momentum);
    });
}

std::vector<reference::SolidBox> MeasuredScene::sweptBoxes(double more) const {
    std::vector<reference::SolidBox> boxes;
    const double margin = 0.5 * marginOf(scene_.step) + more;
    for (size_t p = 0; p < contents_.pieces.size(); ++p) {
        const uint32_t body = contents_.pieces[p].ids.y;
        const gpu::BodyState& state = last_[body];
        const Double3 place = poseOf(state).place;
        reference::Bounds bounds;
        for (const reference::Point& v : pieceInWorld(contents_, p, poseOf(state)).vertices) {
            bounds.grow(v);
            const Double3 arm = turnedBySpin(v - place, scene_.step.dt * vectorOf(state.spin));
            if (moves(body)) bounds.grow(place + arm + scene_.step.dt * vectorOf(state.velocity));
        }
        const double angle = moves(body) ? scene_.step.dt * sizeOf(vectorOf(state.spin)) : 0;
        const double around = margin + bulgeOf(contents_.hulls.records[contents_.pieces[p].ids.x], angle);
        reference::SolidBox box = {.body = body, .fixed = !moves(body)};
        const bool is_plane = (contents_.pieces[p].ids.z & PIECE_PLANE) != 0; // endless, but straight up
        const Double3 up = brittle::turnedBy(poseOf(state).turn, {0, 1, 0});
        for (size_t axis = 0; axis < 3; ++axis) {
            const double rounding = 1e-6 * std::max(std::fabs(bounds.lower[axis]), std::fabs(bounds.upper[axis]));
            const double beyond = (is_plane && std::fabs(up[axis]) < 1 ? 2e6 : 0) + around + (more > 0 ? rounding : 0);
            box.low[axis] = bounds.lower[axis] - beyond;
            box.high[axis] = bounds.upper[axis] + beyond;
        }
        boxes.push_back(box);
    }
    return boxes;
}

std::vector<double> MeasuredScene::overlaps() const {
    std::vector<Pose> poses;
    for (const gpu::BodyState& body : now_)
        poses.push_back(poseOf(body));
    return overlapsOf(contents_, poses);
}

} // namespace support
