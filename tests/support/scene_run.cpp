#include "tests/support/scene_run.h"

#include "modules/brittle/mesh/vector_math.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace support {
namespace {

using brittle::Double3;
using brittle::operator+, brittle::operator-, brittle::operator*, brittle::operator+=;

bool hasCells(const brittle::SceneDescription& scene) {
    return std::ranges::any_of(scene.bodies, [](const brittle::BodyDescription& b) { return b.shape.cells.sites != 0; });
}

Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

Double3 turnedBy(const gpu::vec4& q, const Double3& v) {
    const Double3 u = xyz(q), t = 2.0 * brittle::cross(u, v);
    return v + double{q.w} * t + brittle::cross(u, t);
}

Double3 placeOf(const gpu::BodyState& b) {
    return Double3{16.0 * b.sector.x, 16.0 * b.sector.y, 16.0 * b.sector.z} + xyz(b.offset);
}

double sizeOf(const Double3& v) { return std::sqrt(brittle::dot(v, v)); }

} // namespace

SceneRun::SceneRun(const std::string& name) {
    auto scene = brittle::makeBuiltinScene(name);
    if (!scene) ADD_FAILURE() << scene.error().message;
    if (!scene) return;
    scene_ = *scene;
    std::unique_ptr<brittle::Fracture> fracture;
    if (hasCells(scene_)) {
        auto made = brittle::Fracture::create(engine_test::device());
        if (made) fracture = std::move(*made);
    }
    auto contents = brittle::contentsOf(scene_, ".", fracture.get());
    const auto settings = brittle::settingsOf(scene_);
    if (!contents || !settings) {
        ADD_FAILURE() << (contents ? settings.error().message : contents.error().message);
        return;
    }
    contents_ = std::move(*contents);
    auto world = brittle::World::create(engine_test::device(), contents_, *settings, {scene_.budgets.pairs});
    if (!world) ADD_FAILURE() << world.error().message;
    if (!world) return;
    world_ = std::move(*world);
    first_ = now_ = contents_.bodies;
}

void SceneRun::step(uint32_t steps) {
    ASSERT_NE(world_, nullptr);
    const auto done = world_->step(steps);
    ASSERT_TRUE(done) << done.error().message;
    auto bodies = world_->bodies();
    ASSERT_TRUE(bodies);
    now_ = std::move(*bodies);
    made_ += steps;
}

Double3 SceneRun::place(size_t body) const { return placeOf(now_[body]); }
Double3 SceneRun::way(size_t body) const { return placeOf(now_[body]) - placeOf(first_[body]); }
double SceneRun::speed(size_t body) const { return sizeOf(xyz(now_[body].velocity)); }

double SceneRun::fastest() const {
    double most = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) most = std::max(most, speed(b));
    return most;
}

double SceneRun::furthestWay() const {
    double most = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) most = std::max(most, sizeOf(way(b)));
    return most;
}

double SceneRun::meanWay() const {
    double sum = 0, moving = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) {
            sum += sizeOf(way(b));
            ++moving;
        }
    return moving == 0 ? 0 : sum / moving;
}

double SceneRun::kineticEnergy() const {
    double sum = 0;
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b))
            sum += 0.5 * speed(b) * speed(b) / now_[b].offset.w + 0.5 * brittle::dot(xyz(now_[b].momentum), xyz(now_[b].spin));
    return sum;
}

Double3 SceneRun::momentum() const {
    Double3 sum = {0, 0, 0};
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) sum += (1.0 / now_[b].offset.w) * xyz(now_[b].velocity);
    return sum;
}

Double3 SceneRun::angularMomentum() const {
    Double3 sum = {0, 0, 0};
    for (size_t b = 0; b < now_.size(); ++b)
        if (moves(b)) sum += xyz(now_[b].momentum) + (1.0 / now_[b].offset.w) * brittle::cross(place(b), xyz(now_[b].velocity));
    return sum;
}

bool SceneRun::isFinite() const {
    return std::ranges::all_of(now_, [](const gpu::BodyState& b) {
        const auto finite = [](const gpu::vec4& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
        return finite(b.offset) && finite(b.turn) && finite(b.velocity) && finite(b.spin) && finite(b.momentum);
    });
}

reference::Convex SceneRun::pieceInWorld(size_t piece) const {
    const gpu::uvec4 ids = contents_.pieces[piece].ids;
    const gpu::HullRecord& hull = contents_.hulls.records[ids.x];
    const gpu::BodyState& body = now_[ids.y];
    reference::Convex solid;
    for (uint32_t v = 0; v < hull.count.x; ++v) {
        const Double3 p = place(ids.y) + turnedBy(body.turn, xyz(contents_.hulls.vertices[hull.first.x + v]));
        solid.vertices.push_back({p[0], p[1], p[2]});
    }
    for (uint32_t f = 0; f < hull.count.y; ++f) {
        const gpu::HullFace& face = contents_.hulls.faces[hull.first.y + f];
        const Double3 n = turnedBy(body.turn, xyz(face.plane));
        reference::ConvexFace out;
        out.normal = {n[0], n[1], n[2]};
        for (uint32_t k = 0; k < face.loop.y; ++k)
            out.loop.push_back(contents_.hulls.corners[face.loop.x + k]);
        out.height = double{face.plane.w} + brittle::dot(n, place(ids.y));
        solid.faces.push_back(std::move(out));
    }
    return solid;
}

std::vector<double> SceneRun::overlaps() const {
    std::vector<reference::Convex> solids;
    std::vector<std::array<double, 6>> boxes;
    for (size_t p = 0; p < contents_.pieces.size(); ++p) {
        solids.push_back(pieceInWorld(p));
        std::array<double, 6> box = {1e300, 1e300, 1e300, -1e300, -1e300, -1e300};
        for (const reference::Point& v : solids.back().vertices)
            for (size_t k = 0; k < 3; ++k) {
                box[k] = std::min(box[k], v[k]);
                box[k + 3] = std::max(box[k + 3], v[k]);
            }
        boxes.push_back(box);
    }
    const auto meet = [&](size_t p, size_t q) {
        for (size_t k = 0; k < 3; ++k)
            if (boxes[p][k] > boxes[q][k + 3] || boxes[q][k] > boxes[p][k + 3]) return false;
        return true;
    };
    std::vector<double> depths;
    for (size_t p = 0; p < solids.size(); ++p)
        for (size_t q = p + 1; q < solids.size(); ++q) {
            const uint32_t a = contents_.pieces[p].ids.y, b = contents_.pieces[q].ids.y;
            if (a == b || (!moves(a) && !moves(b)) || !meet(p, q)) continue;
            const double depth = reference::overlapOf(solids[p], solids[q]);
            if (depth > 0) depths.push_back(depth);
        }
    std::ranges::sort(depths);
    return depths;
}

double percentile(const std::vector<double>& sorted, double share) {
    return sorted.empty() ? 0 : sorted[static_cast<size_t>(share * static_cast<double>(sorted.size() - 1))];
}

} // namespace support
