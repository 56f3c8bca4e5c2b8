// Boxes in order that touch each other also sideways: they stand as single stacks do, and nothing sleeps.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription, brittle::ShapeKind;
using brittle::operator-;
using support::SceneRun;

SceneDescription emptyGround() {
    SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction"};
    scene.colliders.emplace_back();
    return scene;
}

void addBox(SceneDescription& scene, const Double3& size, const Double3& place) {
    BodyDescription& box = scene.bodies.emplace_back();
    box.shape = {.kind = ShapeKind::Box, .size = size};
    box.place = place;
}

// Columns of cubes side by side, with gaps between them.
SceneDescription columns(uint32_t count, uint32_t height, double edge, double gap) {
    SceneDescription scene = emptyGround();
    for (uint32_t column = 0; column < count; ++column)
        for (uint32_t level = 0; level < height; ++level)
            addBox(scene, {edge, edge, edge}, {column * (edge + gap), (level + 0.5) * edge, 0});
    return scene;
}

// The bricks measure 0.4 x 0.2 x 0.2 m and lie in running bond, with half bricks at the ends of every other row.
SceneDescription brickWall(uint32_t bricks, uint32_t rows) {
    SceneDescription scene = emptyGround();
    for (uint32_t row = 0; row < rows; ++row) {
        const double y = 0.2 * row + 0.1, first = row % 2 == 0 ? 0.2 : 0.4;
        for (uint32_t k = 0; k < bricks - row % 2; ++k)
            addBox(scene, {0.4, 0.2, 0.2}, {first + 0.4 * k, y, 0});
        if (row % 2 == 0) continue;
        addBox(scene, {0.2, 0.2, 0.2}, {0.1, y, 0});
        addBox(scene, {0.2, 0.2, 0.2}, {0.4 * bricks - 0.1, y, 0});
    }
    return scene;
}

SceneDescription pyramid(uint32_t base) {
    SceneDescription scene = emptyGround();
    for (uint32_t row = 0; row < base; ++row)
        for (uint32_t k = 0; k < base - row; ++k)
            addBox(scene, {0.2, 0.2, 0.2}, {0.21 * k + 0.105 * row, 0.2 * row + 0.1, 0});
    return scene;
}

// The limits are those of a single stack: a hundredth of an edge aside, two hundredths down, 5 mm/s.
void expectToStand(const SceneDescription& scene, double edge) {
    SceneRun run(scene);
    run.step(1200);
    for (size_t body = 0; body < scene.bodies.size(); ++body) {
        const Double3 way = run.place(body) - scene.bodies[body].place;
        EXPECT_LE(std::hypot(way[0], way[2]), 0.01 * edge) << body;
        EXPECT_LE(std::fabs(way[1]), 0.02 * edge) << body;
        const auto& v = run.state(body).velocity;
        EXPECT_LE(std::hypot(v.x, v.y, v.z), 5e-3) << body;
    }
}

TEST(OrderedStacks, OfTwoColumnsThatTouchStand) { expectToStand(columns(2, 8, 1, 0), 1); }

TEST(OrderedStacks, OfTwoColumnsWithANarrowGapStand) { expectToStand(columns(2, 8, 1, 0.01), 1); }
TEST(OrderedStacks, OfBricksInBondStand) { expectToStand(brickWall(5, 10), 0.2); }
TEST(OrderedStacks, OfCubesInRowsStand) { expectToStand(columns(5, 8, 0.2, 0), 0.2); }
TEST(OrderedStacks, ThatGetNarrowerUpwardStand) { expectToStand(pyramid(8), 0.2); }

} // namespace
