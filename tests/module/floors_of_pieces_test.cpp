// Bodies that come in fast and aslant at floors of several pieces: of triangles, of boxes side by side. Without friction
// nothing that is level can hold them back, whatever the pieces have for sides.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/flight_scene.h"
#include "tests/support/scene_run.h"
#include "tests/support/shots.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::BodyDescription, brittle::ColliderDescription, brittle::SceneDescription, brittle::ShapeKind;
using support::Shot, support::ShotDraw, support::SceneRun;

constexpr brittle::SurfaceDescription kSmooth = {.friction = 0, .restitution = 0};

// 200 m wide, cut into strips of two triangles each, 1 m wide.
std::shared_ptr<brittle::ImportedMesh> stripsAt(double offset) {
    constexpr uint32_t kStrips = 200;
    auto model = std::make_shared<brittle::ImportedMesh>();
    for (uint32_t line = 0; line <= kStrips; ++line)
        for (const double side : {-100.0, 100.0})
            model->positions.push_back({line - 0.5 * kStrips + offset, side + offset, 0});
    for (uint32_t corner = 0; corner < 2 * kStrips; corner += 2) {
        model->triangles.push_back({corner, corner + 2, corner + 1});
        model->triangles.push_back({corner + 1, corner + 2, corner + 3});
    }
    model->corner_normals.resize(3 * model->triangles.size());
    model->corner_uvs.resize(3 * model->triangles.size());
    return model;
}

void addTriangles(SceneDescription& scene, double offset) {
    ColliderDescription& floor = scene.colliders.emplace_back();
    floor.shape.kind = ShapeKind::Mesh;
    floor.shape.model = stripsAt(offset);
    floor.surface = kSmooth;
}

void addTiles(SceneDescription& scene, double offset) {
    for (int k = -12; k < 40; ++k) {
        ColliderDescription& tile = scene.colliders.emplace_back();
        tile.shape = {.kind = ShapeKind::Box, .size = {1, 20, 0.1}};
        tile.place = {k + offset, 0, -0.05};
        tile.surface = kSmooth;
    }
}

using AddFloor = void (*)(SceneDescription&, double);

class FloorsOfPieces : public testing::TestWithParam<AddFloor> {};

TEST_P(FloorsOfPieces, StopWhatComesInAslantWhereItTouchesAndLetItGoOn) {
    for (const double speed : {20., 60., 200.})
        for (const uint32_t cells : {0u, 8u})
            for (const double offset : {-0.4, 0.1, 0.3}) {
                SceneDescription scene = support::flightScene();
                BodyDescription& cube = scene.bodies.emplace_back();
                cube.shape = {.kind = ShapeKind::Box, .size = {0.2, 0.2, 0.2}, .cells = {.sites = cells}};
                cube.place = {-1.98, 0.03, 2.64};
                cube.velocity = {0.6 * speed, 0, -0.8 * speed};
                cube.surface = kSmooth;
                GetParam()(scene, offset);
                SceneRun run(scene);
                run.step(12);
                const auto label = testing::Message() << speed << " m/s, " << cells << " cells, off by " << offset;
                EXPECT_NEAR(run.place(0)[2], 0.1, 1e-3 * speed / 60) << label;
                EXPECT_NEAR(double{run.state(0).velocity.x}, 0.6 * speed, 1e-3 * speed) << label;
            }
}

INSTANTIATE_TEST_SUITE_P(, FloorsOfPieces, testing::Values(addTriangles, addTiles),
                         [](const auto& test) { return test.index == 0 ? "Triangles" : "Tiles"; });

class FloorOfTriangles : public testing::TestWithParam<Shot> {};

// Turned, at times spinning or elastic. They tumble on by radians a step.
TEST_P(FloorOfTriangles, LetsNothingThroughAndTakesNoSpeedAlongIt) {
    for (const double speed : {30., 100.})
        for (uint32_t seed = 0; seed < 6; ++seed) {
            ShotDraw draw(100 + seed);
            SceneDescription scene = support::flightScene();
            BodyDescription& shot = support::addShot(scene, GetParam(), speed, draw);
            shot.place = {-1.98, 0.03, 2.64};
            shot.velocity = {0.6 * speed, 0.2 * speed, -0.8 * speed};
            shot.surface.friction = 0;
            addTriangles(scene, draw.upTo(1));
            SceneRun run(scene);
            run.step(1);
            const double energy = run.kineticEnergy();
            run.step(20);
            const auto label = testing::Message() << speed << " m/s, seed " << seed;
            EXPECT_GT(run.place(0)[2], 0) << label;
            EXPECT_NEAR(double{run.state(0).velocity.x}, 0.6 * speed, 1e-3 * speed) << label;
            EXPECT_NEAR(double{run.state(0).velocity.y}, 0.2 * speed, 1e-3 * speed) << label;
            EXPECT_LE(run.kineticEnergy(), 1.001 * energy) << label;
        }
}

INSTANTIATE_TEST_SUITE_P(, FloorOfTriangles, testing::ValuesIn(support::kShots),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
