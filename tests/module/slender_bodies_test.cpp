// Bodies that are thin for their length, at blows that turn them within a step by more than they are thick.
#include "tests/support/flight_scene.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

namespace {

using brittle::BodyDescription, brittle::SceneDescription, brittle::ShapeKind;
using support::flightScene, support::SceneRun;

constexpr double kApart = 4; // m, more than any of these bodies is long

BodyDescription& addRodOfCells(SceneDescription& scene, double speed, double from, double spin) {
    BodyDescription& rod = scene.bodies.emplace_back();
    rod.shape = {.kind = ShapeKind::Box, .size = {0.02, 0.6, 0.02}, .cells = {.sites = 6}};
    rod.place = {kApart * static_cast<double>(scene.bodies.size()), 0, from};
    rod.velocity = {0, 0, -speed};
    rod.spin = {0, 0, spin};
    return rod;
}

void expectNothingIsGained(SceneRun& run, uint32_t steps) {
    std::vector<double> energies(run.bodyCount());
    for (size_t body = 0; body < energies.size(); ++body)
        energies[body] = run.kineticEnergy(body);
    for (uint32_t step = 0; step < steps; ++step) {
        run.step(1);
        for (size_t body = 0; body < energies.size(); ++body) {
            if (!run.moves(body)) continue;
            ASSERT_LE(run.kineticEnergy(body), 1.001 * energies[body]) << "body " << body << ", step " << step;
        }
    }
}

// All cells of a rod hit at once. The later in a step, the further has the rod turned by then.
TEST(SlenderBodies, OfCellsThatTurnGainNothingAtAWall) {
    for (const double friction : {0., 0.6}) {
        SceneDescription scene = flightScene();
        for (const double speed : {4., 10., 20., 30., 100.})
            for (const double spin : {2., 5., -7.})
                for (uint32_t phase = 0; phase < 4; ++phase)
                    addRodOfCells(scene, speed, 3 + 0.27 * phase * speed / 60, spin).surface = {.friction = friction,
                                                                                                .restitution = 0};
        brittle::ColliderDescription& wall = scene.colliders.emplace_back();
        wall.shape = {.kind = ShapeKind::Box, .size = {900, 900, 0.01}};
        wall.surface = {.friction = friction, .restitution = 0};
        SceneRun run(scene);
        run.step(1);
        expectNothingIsGained(run, 60);
    }
}

} // namespace
