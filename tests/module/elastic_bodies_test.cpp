// Bodies that lose nothing when they bounce: thin ones at any tilt, and rows that pass a blow on.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/flight_scene.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription, brittle::ShapeKind;
using brittle::operator*;
using support::flightScene, support::SceneRun;

constexpr double kApart = 4; // m, more than any of these bodies is long

struct Plank {
    const char* name;
    Double3 size;
};

const Plank kPlanks[] = {
    {"rod", {0.08, 2, 0.08}}, {"plate", {1.294, 0.043, 1.765}}, {"tile", {0.5, 0.5, 0.02}}, {"board", {1, 0.3, 0.1}}};

class ElasticBodies : public testing::TestWithParam<Plank> {};

// 0.1 % and 2 % are what a bounce may gain and lose.
TEST_P(ElasticBodies, KeepTheirEnergyAtAnyTilt) {
    SceneDescription scene = flightScene();
    std::mt19937 random(1);
    std::normal_distribution<double> any;
    for (uint32_t k = 0; k < 48; ++k) {
        BodyDescription& plank = scene.bodies.emplace_back();
        plank.shape = {.kind = ShapeKind::Box, .size = GetParam().size};
        plank.place = {kApart * (k % 8), 3, kApart * (k / 8)};
        plank.turn = {any(random), any(random), any(random), any(random)};
        plank.velocity = {0, -7.67, 0};
        plank.surface = {.friction = 0, .restitution = 1};
    }
    scene.colliders.emplace_back().surface = {.friction = 0, .restitution = 1};
    SceneRun run(scene);
    run.step(1);
    std::vector<double> energies(run.bodyCount());
    for (size_t body = 0; body < energies.size(); ++body)
        energies[body] = run.kineticEnergy(body);
    run.step(60);
    for (size_t body = 0; body < energies.size(); ++body) {
        if (!run.moves(body)) continue;
        EXPECT_LE(run.kineticEnergy(body), 1.001 * energies[body]) << "body " << body;
        EXPECT_GE(run.kineticEnergy(body), 0.98 * energies[body]) << "body " << body;
    }
}

INSTANTIATE_TEST_SUITE_P(, ElasticBodies, testing::ValuesIn(kPlanks),
                         [](const auto& test) { return std::string(test.param.name); });

// A cube flies into a row of cubes that touch, all turned about y by `degrees`. It meets them just when a substep ends:
// by rounding some corners of its face meet in that substep and some in the next.
void expectThatTheLastOneLeaves(double degrees, uint32_t cubes) {
    const double angle = degrees * std::numbers::pi / 180, edge = 0.5, speed = 4;
    const Double3 along = {std::cos(angle), 0, -std::sin(angle)};
    SceneDescription scene = flightScene();
    for (uint32_t k = 0; k <= cubes; ++k) {
        BodyDescription& cube = scene.bodies.emplace_back();
        cube.shape = {.kind = ShapeKind::Box, .size = {edge, edge, edge}};
        cube.place = (k == 0 ? -1.25 : edge * (k - 1)) * along;
        cube.turn = {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
        if (k == 0) cube.velocity = speed * along;
        cube.surface = {.friction = 0, .restitution = 1};
    }
    SceneRun run(scene);
    run.step(30);
    for (uint32_t k = 0; k <= cubes; ++k) {
        EXPECT_NEAR(run.speed(k), k == cubes ? speed : 0, 1e-3 * speed)
            << "cube " << k << " of " << cubes << ", " << degrees << " degrees";
        const gpu::vec4 v = run.state(k).velocity;
        if (k == cubes) {
            EXPECT_NEAR(v.x * along[0] + v.z * along[2], speed, 1e-3 * speed) << degrees << " degrees";
        }
    }
}

TEST(ElasticRows, PassABlowOnHoweverTheyAreTurned) {
    for (const double degrees : {-60., -30., -17., 0., 10., 30., 45.})
        for (const uint32_t cubes : {2u, 5u})
            expectThatTheLastOneLeaves(degrees, cubes);
}

} // namespace
