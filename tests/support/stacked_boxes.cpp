#include "tests/support/stacked_boxes.h"

#include "modules/brittle/scene/body_shape.h"

#include <algorithm>

namespace support {
namespace {

using reference::length;
using reference::Point;
using reference::StackedBox;
using reference::operator-;

Point xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

// Of the hull's face that looks that way along y.
StackedBox::Face faceOf(const brittle::WorldContents& contents, size_t piece, double up) {
    const brittle::HullSet& hulls = contents.hulls;
    const gpu::HullRecord& hull = hulls.records[contents.pieces[piece].ids.x];
    StackedBox::Face corners = {};
    for (uint32_t f = hull.first.y; f < hull.first.y + hull.count.y; ++f) {
        const gpu::HullFace& face = hulls.faces[f];
        if (up * face.plane.y < 0.5) continue;
        for (uint32_t c = 0; c < corners.size(); ++c)
            corners[c] = xyz(hulls.vertices[hull.first.x + hulls.corners[face.loop.x + c]]);
    }
    return corners;
}

} // namespace

engine::Result<std::vector<StackedBox>> stackedBoxes(const brittle::SceneDescription& scene) {
    const auto contents = brittle::contentsOf(scene, ".", nullptr);
    if (!contents) return contents.error();
    std::vector<StackedBox> boxes;
    for (size_t k = 0; k < contents->bodies.size(); ++k)
        boxes.push_back({.bottom = faceOf(*contents, k, -1), .top = faceOf(*contents, k, 1)});
    for (size_t k = 0; k < scene.bodies.size(); ++k) {
        const brittle::BodyDescription& body = scene.bodies[k];
        const Point& s = body.shape.size;
        boxes[k].place = body.place;
        boxes[k].mass = brittle::massOf(body, body.density.value_or(brittle::kUsualDensity), s[0] * s[1] * s[2]);
        for (size_t axis = 0; axis < 3; ++axis)
            boxes[k].moments[axis] = boxes[k].mass / 12 * (reference::dot(s, s) - s[axis] * s[axis]);
        boxes[k].friction = body.surface.friction;
        boxes[k].velocity = body.velocity;
        boxes[k].spin = body.spin;
    }
    boxes.back().friction = scene.colliders.front().surface.friction; // the ground, whose middle is below the stack
    return boxes;
}

reference::StackSettings stackSettings(const brittle::SceneDescription& scene) {
    const brittle::StepDescription& step = scene.step;
    return {scene.gravity, step.dt, step.substeps, step.contact_hertz, step.contact_damping, step.push_out, marginOf(step)};
}

StackDifference differenceOf(const MeasuredScene& run, const reference::RigidStack& stack) {
    const double edge = run.scene().bodies[0].shape.size[1], speed = length(run.scene().gravity) * run.scene().step.dt;
    StackDifference most;
    for (size_t b = 0; b < run.scene().bodies.size(); ++b) {
        const reference::RigidBody& body = stack.bodies()[b];
        const gpu::BodyState& state = run.state(b);
        const reference::UnitQuaternion turn = {state.turn.x, state.turn.y, state.turn.z, state.turn.w};
        most.place = std::max(most.place, length(run.place(b) - body.place) / edge);
        most.turn = std::max(most.turn, reference::angleBetween(turn, body.turn));
        most.velocity = std::max(most.velocity, length(xyz(state.velocity) - body.velocity) / speed);
        most.spin = std::max(most.spin, length(xyz(state.spin) - body.spin) / (speed / edge));
    }
    return most;
}

} // namespace support
