// The hard scene that is compared, body by body, with the same method in double precision.
#include "modules/brittle/scene/body_shape.h"
#include "tests/reference/rigid_stack.h"
#include "tests/support/known_shortfall.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace {

using reference::length;
using reference::Point;
using reference::StackedBox;
using reference::operator-;
using support::knownShortfall;
using support::SceneRun;

Point xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

// Of the hull's face that looks that way along y.
StackedBox::Face faceOf(const brittle::WorldContents& contents, size_t piece, double up) {
    const brittle::HullSet& hulls = contents.hulls;
    const gpu::HullRecord& hull = hulls.records[contents.pieces[piece].ids.x];
    StackedBox::Face corners = {};
    for (uint32_t f = hull.first.y; f < hull.first.y + hull.count.y; ++f) {
        const gpu::HullFace& face = hulls.faces[f];
        if (up * face.plane.y < 0.5) continue;
        EXPECT_EQ(face.loop.y, corners.size());
        for (uint32_t c = 0; c < corners.size(); ++c)
            corners[c] = xyz(hulls.vertices[hull.first.x + hulls.corners[face.loop.x + c]]);
    }
    return corners;
}

std::vector<StackedBox> boxesOf(const brittle::SceneDescription& scene) {
    const auto contents = brittle::contentsOf(scene, ".", nullptr);
    if (!contents) ADD_FAILURE() << contents.error().message;
    if (!contents) return {};
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
    return {scene.gravity, step.dt, step.substeps, step.contact_hertz, step.contact_damping, step.push_out, step.margin};
}

// The furthest that any body is from what the oracle says of it: places in edges of a cube, turns in radians, velocities in
// what gravity adds in a step, spins in that speed an edge.
struct Difference {
    double place = 0, turn = 0, velocity = 0, spin = 0;
};

Difference differenceOf(const SceneRun& run, const reference::RigidStack& stack) {
    const double edge = run.scene().bodies[0].shape.size[1], speed = length(run.scene().gravity) * run.scene().step.dt;
    Difference most;
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

void stepBoth(SceneRun& run, reference::RigidStack& stack, uint32_t steps) {
    run.step(steps);
    for (uint32_t k = 0; k < steps; ++k)
        stack.step();
}

// The points of the oracle are those of the first step. Of the world's, too, as long as it finds none anew.
void expectPointsKept(SceneRun& run, const reference::RigidStack& stack) {
    const auto counts = run.world().counts();
    ASSERT_TRUE(counts);
    EXPECT_EQ(counts->fresh, 0u);
    EXPECT_EQ(counts->contacts, stack.contacts().size());
    EXPECT_TRUE(stack.hardlyMoved());
}

// Cubes that touch are where the method is not continuous: a gap of 1e-15 m instead of none changes speeds after the step by a
// hundredth of what gravity adds. So both must find the same gaps closed, as they do where the world falls alike bit for bit.
//
// What remains of velocities and spins comes from the matrix that presses all points at once (prepare_contacts): made in fp32,
// its inverse errs so much that the reference with such an inverse is as far off, 1.2e-6 and 2.9e-6. Rounding impulses,
// velocities and spins to fp32 makes less than a tenth of that.
TEST(HardScenes, hard_30_reference) {
    SceneRun run("hard_30_reference");
    reference::RigidStack stack(boxesOf(run.scene()), stackSettings(run.scene()));
    ASSERT_EQ(stack.contacts().size(), run.scene().bodies.size());
    stepBoth(run, stack, 1);
    const Difference after_one = differenceOf(run, stack);
    EXPECT_LE(after_one.place, 1e-6);
    EXPECT_LE(after_one.turn, 1e-6);
    EXPECT_LE(after_one.velocity, 1e-6);
    knownShortfall("spin of the cubes after one step, off from the reference", after_one.spin, 1e-6);
    stepBoth(run, stack, run.scene().step.steps - 1);
    const Difference in_the_end = differenceOf(run, stack);
    EXPECT_LE(in_the_end.place, 1e-3);
    expectPointsKept(run, stack);
    std::printf("off by %.2g of an edge after a step, by %.2g after %u\n", after_one.place, in_the_end.place,
                run.scene().step.steps);
}

// The stack of hard_30 only sinks; these are rubbed. For 80 steps: by then they lie still, and what rounding leaves of pushes is
// all that moves them (2e-5 of what gravity adds in a step, at step 120).
TEST(World, CubesThatSlideAndTwistMoveAsTheReferenceSays) {
    brittle::SceneDescription scene = *brittle::makeBuiltinScene("stack_3");
    scene.effects = {"gravity", "contacts", "friction"};
    scene.bodies[0].velocity = {0.05, 0, 0.1};
    scene.bodies[1].spin = {0, 0.1, 0};
    scene.bodies[2].velocity = {-0.1, 0, 0.05};
    SceneRun run(scene);
    reference::RigidStack stack(boxesOf(scene), stackSettings(scene));
    for (const uint32_t steps : {1, 9, 70}) {
        stepBoth(run, stack, steps);
        const Difference now = differenceOf(run, stack);
        EXPECT_LE(now.place, 1e-6) << "after another " << steps;
        EXPECT_LE(now.turn, 1e-6) << "after another " << steps;
        EXPECT_LE(now.velocity, 1e-5) << "after another " << steps;
        EXPECT_LE(now.spin, 1e-5) << "after another " << steps;
        if (steps == 1) {
            EXPECT_GT(run.furthestWay(), 1e-3) << "nothing slides";
        }
    }
    expectPointsKept(run, stack);
}

} // namespace
