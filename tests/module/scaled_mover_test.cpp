// A scene that moves at another size gives back the motion of its own size.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/engine/test_device.h"
#include "tests/hard/hard_case.h"
#include "tests/support/scaled_mover.h"
#include "tests/support/scaled_scene.h"
#include "tests/support/world_mover.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::Double3, brittle::SceneDescription;
using brittle::operator-;
using engine::ErrorCode, engine::Result;
using support::MakeMover, support::MeasuredScene, support::Mover;

class ScaledMovers : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Sizes, ScaledMovers, testing::Values(1e-2, 1, 1e2), [](const auto& one) {
    return one.param < 1 ? "Small" : one.param > 1 ? "Large" : "AsDescribed";
});

SceneDescription sceneOf(const brittle::BodyDescription& body, uint32_t steps) {
    SceneDescription scene;
    scene.step.steps = steps;
    scene.bodies.push_back(body);
    return scene;
}

// A rod of 8 cells, which tumbles while it falls for a second.
SceneDescription freeFall() {
    brittle::BodyDescription rod;
    rod.shape.size = {0.2, 1, 0.3};
    rod.shape.cells.sites = 8;
    rod.place = {3, 20, -2};
    rod.velocity = {2, 1, 0};
    rod.spin = {1, 0.5, 2};
    return sceneOf(rod, 60);
}

// A cube of 1 m on the ground for two seconds.
SceneDescription cubeAtRest() {
    SceneDescription scene = sceneOf({.place = {0, 0.5, 0}}, 120);
    scene.colliders.emplace_back();
    return scene;
}

void finish(MeasuredScene& run, const MakeMover& make_mover) {
    const auto made = run.make(engine_test::device(), make_mover);
    ASSERT_TRUE(made) << made.error().message;
    const auto done = run.advance(run.stepsLeft());
    ASSERT_TRUE(done) << done.error().message;
}

double turnBetween(const gpu::vec4& a, const gpu::vec4& b) {
    return 2 *
           std::acos(std::min(1.0, std::fabs(double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z + double{a.w} * b.w)));
}

// m. The end of a fall, off from Newton's by what `make_inner` moves wrongly at that scale.
double offFromNewton(double scale, const MakeMover& make_inner = {}) {
    MeasuredScene run(freeFall());
    finish(run, support::scaledMover(engine_test::device(), scale, make_inner));
    const double t = 1;
    return brittle::length(run.place(0) - Double3{3 + 2 * t, 20 + t - 0.5 * 9.81 * t * t, -2});
}

TEST_P(ScaledMovers, FallAsNewtonSays) { EXPECT_LT(offFromNewton(GetParam()), 1e-3); }

TEST_P(ScaledMovers, FallAndTurnAsTheSceneOfItsOwnSize) {
    MeasuredScene own(freeFall()), other(freeFall());
    finish(own, {});
    finish(other, support::scaledMover(engine_test::device(), GetParam()));
    EXPECT_LT(brittle::length(other.place(0) - own.place(0)), 1e-4);
    EXPECT_LT(turnBetween(other.state(0).turn, own.state(0).turn), 2e-3);
    EXPECT_NEAR(other.speed(0) / own.speed(0), 1, 1e-5);
    EXPECT_NEAR(other.kineticEnergy() / own.kineticEnergy(), 1, 1e-4);
    EXPECT_NEAR(other.angularMomentumInAll() / own.angularMomentumInAll(), 1, 1e-4);
    EXPECT_NEAR(other.substep() / own.substep(), 1, 1e-9);
}

TEST_P(ScaledMovers, RestWhereTheSceneOfItsOwnSizeDoes) {
    MeasuredScene own(cubeAtRest()), other(cubeAtRest());
    finish(own, {});
    finish(other, support::scaledMover(engine_test::device(), GetParam()));
    EXPECT_LT(brittle::length(other.way(0) - own.way(0)), 2e-5);
    EXPECT_LT(other.fastest(), 1e-4);
    ASSERT_EQ(other.overlaps().size(), own.overlaps().size());
    EXPECT_NEAR(support::percentile(other.overlaps(), 1), support::percentile(own.overlaps(), 1), 2e-5);
}

// A Brittle world of a scene that `change` has made wrong.
template <typename Change>
MakeMover worldOf(const Change& change) {
    return [change](SceneDescription scene, const brittle::WorldContents& contents) -> Result<std::unique_ptr<Mover>> {
        change(scene);
        auto mover = support::WorldMover::make(engine_test::device(), scene, contents);
        if (!mover) return mover.error();
        return Result<std::unique_ptr<Mover>>(std::move(*mover));
    };
}

TEST(ScaledMover, ShowsAWrongScaling) {
    const auto same_steps = worldOf([](SceneDescription& scene) { scene.step.dt = 1.0 / 60; });
    const auto other_gravity = worldOf([](SceneDescription& scene) { scene.gravity[1] *= 1.1; });
    EXPECT_GT(offFromNewton(0.01, same_steps), 1);
    EXPECT_GT(offFromNewton(100, same_steps), 1);
    EXPECT_GT(offFromNewton(100, other_gravity), 0.4);
    EXPECT_LT(offFromNewton(100, worldOf([](SceneDescription&) {})), 1e-3);
}

TEST(ScaledMover, MovesTheScaledScene) {
    const MakeMover expecting = [](const SceneDescription& scene, const brittle::WorldContents& contents) {
        EXPECT_EQ(scene, support::scaled(cubeAtRest(), 100));
        EXPECT_NEAR(contents.bodies[0].offset.w, 1e-9, 1e-15) << "1000 kg, a million times as heavy";
        return Result<std::unique_ptr<Mover>>(engine::Error{ErrorCode::Feature, "not today"});
    };
    hard::Trial trial(engine_test::device(), support::scaledMover(engine_test::device(), 100, expecting));
    trial.scene(cubeAtRest());
    EXPECT_TRUE(trial.isLeftOut()) << "the inner mover cannot move it";
    EXPECT_EQ(trial.failure(), "not today");
}

TEST(ScaledScene, ScalesLengthsTimesSpeedsRatesAndMasses) {
    SceneDescription scene = freeFall();
    scene.bodies[0].mass = 3;
    scene.bodies[0].shape.points = {{1, 2, 3}};
    scene.step.margin = 0.02;
    scene.step.push_out = 3;
    scene.step.contact_hertz = 30;
    const SceneDescription large = support::scaled(scene, 4);
    EXPECT_EQ(large.bodies[0].place, (Double3{12, 80, -8}));
    EXPECT_EQ(large.bodies[0].shape.size, (Double3{0.8, 4, 1.2}));
    EXPECT_EQ(large.bodies[0].shape.points[0], (Double3{4, 8, 12}));
    EXPECT_EQ(large.bodies[0].velocity, (Double3{4, 2, 0}));
    EXPECT_EQ(large.bodies[0].spin, (Double3{0.5, 0.25, 1}));
    EXPECT_EQ(large.bodies[0].mass, 192);
    EXPECT_EQ(large.step.dt, 2 * scene.step.dt);
    EXPECT_EQ(large.step.margin, 0.08);
    EXPECT_EQ(large.step.push_out, 6);
    EXPECT_EQ(large.step.bounce_speed, 0.5);
    EXPECT_EQ(large.step.contact_hertz, 15);
    EXPECT_EQ(large.events.impact_speed, 0.5);
    EXPECT_EQ(large.breaking.smallest_piece, 0.008);
    EXPECT_EQ(large.gravity, scene.gravity);
    EXPECT_EQ(support::scaled(scene, 1), scene);
}

} // namespace
