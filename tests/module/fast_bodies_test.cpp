// Bodies that are fast for their size, however they come in: turned, spinning, off the middle of what they hit. What they hit
// is thinner than what they go in a step.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/flight_scene.h"
#include "tests/support/scene_run.h"
#include "tests/support/shots.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription, brittle::ShapeKind;
using brittle::operator-, brittle::operator*;
using support::addShot, support::flightScene, support::kShots, support::SceneRun, support::Shot;
using Draw = support::ShotDraw;

constexpr double kThickness = 0.05; // of walls

class FastBodies : public testing::TestWithParam<Shot> {};

TEST_P(FastBodies, NeverPassAWallAndGainNothing) {
    for (const double speed : {30., 100., 300., 1000.})
        for (uint32_t seed = 0; seed < 2; ++seed) {
            SceneDescription scene = flightScene();
            Draw draw(seed);
            addShot(scene, GetParam(), speed, draw);
            brittle::ColliderDescription& wall = scene.colliders.emplace_back();
            wall.shape = {.kind = ShapeKind::Box, .size = {kThickness, 900, 900}};
            SceneRun run(scene);
            run.step(1);
            const double energy = run.kineticEnergy();
            for (uint32_t step = 0; step < 15; ++step) {
                run.step(1);
                ASSERT_TRUE(run.isFinite());
                ASSERT_LT(run.place(0)[0], kThickness / 2) << speed << " m/s, seed " << seed << ", step " << step;
                ASSERT_LE(run.kineticEnergy(), 1.001 * energy) << speed << " m/s, seed " << seed << ", step " << step;
            }
        }
}

constexpr double kPlate = 2; // m, its edges

// From before the plate to behind it, in its own frame, and not beside it: what comes in aslant may miss it or slide off its
// edge.
bool wentThrough(const Double3& before, const Double3& now) {
    const double front = kThickness / 2;
    if (before[0] > front || now[0] <= front) return false;
    const double share = (front - before[0]) / (now[0] - before[0]);
    const auto at = [&](size_t axis) { return std::fabs(before[axis] + share * (now[axis] - before[axis])); };
    return at(1) < kPlate / 2 && at(2) < kPlate / 2;
}

TEST_P(FastBodies, NeverPassAPlateThatIsFreeOrComesAtThem) {
    for (const double speed : {30., 100., 300.})
        for (uint32_t seed = 0; seed < 2; ++seed) {
            SceneDescription scene = flightScene();
            Draw draw(10 + seed);
            addShot(scene, GetParam(), speed, draw);
            BodyDescription& plate = scene.bodies.emplace_back();
            plate.shape = {.kind = ShapeKind::Box, .size = {kThickness, kPlate, kPlate}};
            if (seed % 2 == 1) plate.velocity = {-speed, 0, 0};
            SceneRun run(scene);
            const Double3 momentum = [&] { return run.step(1), run.momentum(); }();
            const double energy = run.kineticEnergy(), momentum_in_all = run.momentumInAll();
            const auto inPlate = [&] {
                const brittle::Pose now = brittle::poseOf(run.state(1));
                return brittle::turnedBack(now.turn, run.place(0) - now.place);
            };
            Double3 before = inPlate();
            for (uint32_t step = 0; step < 15; ++step) {
                run.step(1);
                ASSERT_TRUE(run.isFinite());
                const Double3 now = inPlate(), gained = run.momentum() - momentum;
                ASSERT_FALSE(wentThrough(before, now))
                    << speed << " m/s, seed " << seed << ", step " << step << ", at " << now[1] << ", " << now[2];
                before = now;
                ASSERT_LE(brittle::length(gained), 1e-6 * momentum_in_all) << speed << " m/s, seed " << seed;
                ASSERT_LE(run.kineticEnergy(), 1.001 * energy) << speed << " m/s, seed " << seed << ", step " << step;
            }
        }
}

INSTANTIATE_TEST_SUITE_P(, FastBodies, testing::ValuesIn(kShots),
                         [](const auto& test) { return std::string(test.param.name); });

// Without friction the way along the wall is not held back. What stopped before the wall would fly along it at that distance.
TEST(FastBodiesThatComeInAslant, StopWhereTheyTouch) {
    for (const double speed : {20., 40., 60., 100., 200.})
        for (const uint32_t cells : {0u, 8u}) {
            SceneDescription scene = flightScene();
            BodyDescription& cube = scene.bodies.emplace_back();
            cube.shape = {.kind = ShapeKind::Box, .size = {0.2, 0.2, 0.2}, .cells = {.sites = cells}};
            cube.place = {-1.98, 0, 2.64};
            cube.velocity = {0.6 * speed, 0, -0.8 * speed};
            cube.surface = {.friction = 0, .restitution = 0};
            brittle::ColliderDescription& wall = scene.colliders.emplace_back();
            wall.shape = {.kind = ShapeKind::Box, .size = {200, 200, kThickness}};
            wall.surface = cube.surface;
            SceneRun run(scene);
            run.step(20);
            EXPECT_NEAR(run.place(0)[2], 0.1 + kThickness / 2, 1e-3 * speed / 60) << speed << " m/s, " << cells << " cells";
            EXPECT_NEAR(double{run.state(0).velocity.x}, 0.6 * speed, 1e-3 * speed) << speed << " m/s, " << cells << " cells";
        }
}

// Their way leads along the wall after the blow, through another one that nothing had led to before.
TEST(FastBodiesInACorner, StayInIt) {
    for (uint32_t seed = 0; seed < 8; ++seed) {
        SceneDescription scene = flightScene();
        Draw draw(20 + seed);
        BodyDescription& shot = addShot(scene, kShots[0], 300, draw);
        shot.velocity = {300, 0, 0};
        shot.surface = {.friction = 0, .restitution = 0};
        brittle::ColliderDescription& slope = scene.colliders.emplace_back();
        slope.shape = {.kind = ShapeKind::Box, .size = {kThickness, 90, 90}};
        slope.turn = {0, 0, std::sin(-0.3), std::cos(0.3)};
        slope.surface = shot.surface;
        brittle::ColliderDescription& roof = scene.colliders.emplace_back();
        roof.shape = {.kind = ShapeKind::Box, .size = {90, kThickness, 90}};
        roof.place = {0, 1.5, 0};
        SceneRun run(scene);
        for (uint32_t step = 0; step < 20; ++step) {
            run.step(1);
            ASSERT_LT(run.place(0)[1], 1.5) << "seed " << seed << ", step " << step;
        }
    }
}

// A plane is endless: bodies stand on it, and slide along it, wherever they are.
TEST(Planes, BearBodiesAnywhere) {
    SceneDescription scene = flightScene();
    scene.gravity = {0, -10, 0};
    scene.effects.push_back("gravity");
    const Double3 places[] = {{0, 0.6, 0}, {9e4, 0.6, 3}, {-7e5, 0.6, -4e5}};
    for (const Double3& place : places) {
        BodyDescription& cube = scene.bodies.emplace_back();
        cube.shape = {.kind = ShapeKind::Box, .size = {1, 1, 1}};
        cube.place = place;
    }
    BodyDescription& sliding = scene.bodies.emplace_back(scene.bodies[0]);
    sliding.place = {0, 0.5, 50};
    sliding.velocity = {300, 0, 0};
    sliding.surface.friction = 0;
    scene.colliders.emplace_back();
    SceneRun run(scene);
    run.step(120);
    for (size_t body = 0; body < 4; ++body)
        EXPECT_NEAR(run.place(body)[1], 0.5, 2e-3) << body;
    EXPECT_NEAR(run.way(3)[0], 600, 1);
}

SceneDescription onAPlane(double gravity) {
    SceneDescription scene = flightScene();
    scene.gravity = {0, -gravity, 0};
    scene.effects.push_back("gravity");
    scene.colliders.emplace_back();
    return scene;
}

BodyDescription& addCube(SceneDescription& scene, double edge, const Double3& place) {
    BodyDescription& cube = scene.bodies.emplace_back();
    cube.shape = {.kind = ShapeKind::Box, .size = {edge, edge, edge}};
    cube.place = place;
    return cube;
}

// Below a plane there is nowhere to be pushed to but up.
TEST(Planes, BringBackWhatIsWithinTenMetersBelow) {
    SceneDescription scene = onAPlane(10);
    for (const double depth : {1.0, 5.0, 5.5, 7.0, 9.4})
        addCube(scene, 1, {3 * depth, -depth, 0});
    SceneRun run(scene);
    run.step(600);
    for (size_t body = 0; body < scene.bodies.size(); ++body)
        EXPECT_NEAR(run.place(body)[1], 0.5, 5e-3) << body;
}

TEST(Planes, BearWhatFallsOnThemAtAHundredTimesEarthsGravity) {
    SceneDescription scene = onAPlane(1000);
    addCube(scene, 1, {0, 5, 0});
    addCube(scene, 1, {0, 7, 0});
    SceneRun run(scene);
    run.step(300);
    for (size_t body = 0; body < 2; ++body)
        EXPECT_GT(run.place(body)[1], 0.4);
}

// Moments of inertia from 1e-18 to 1e24 kg m2.
TEST(BodiesOfAnySize, SpinOnAsTheyDid) {
    for (const double edge : {1e-2, 1.0, 150.0, 1e4})
        for (const double density : {1e-2, 1e3, 1e5}) {
            if (density * edge * edge * edge > 1e13 || density * edge * edge * edge < 1e-6) continue;
            SceneDescription scene = flightScene();
            BodyDescription& brick = addCube(scene, edge, {0, 0, 0});
            brick.shape.size[1] *= 0.5;
            brick.density = density;
            brick.spin = {0, 3, 0};
            SceneRun run(scene);
            run.step(60);
            EXPECT_NEAR(double{run.state(0).spin.y}, 3, 1e-4) << edge << " m, " << density;
        }
}

TEST(BodiesOfAnySize, FallAndComeToRest) {
    for (const double edge : {5e-3, 1.0, 150.0}) {
        SceneDescription scene = onAPlane(10);
        addCube(scene, edge, {0, 0.6 * edge, 0}).spin = {0.1, 0.2, 0};
        SceneRun run(scene);
        run.step(300);
        EXPECT_NEAR(run.place(0)[1] / edge, 0.5, 1e-2) << edge;
    }
}

} // namespace
