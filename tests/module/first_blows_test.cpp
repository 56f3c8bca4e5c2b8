// The impact that comes first in a step breaks a body, among its own pieces and among several bodies. Tests check its place,
// its time, and that no later impact counts.
#include "modules/brittle/scene/scene_file.h"
#include "tests/module/breaking_scenes.h"
#include "tests/support/folders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription;
using brittle::operator*;

BodyDescription boxOfPieces() {
    BodyDescription box;
    box.name = "box";
    box.shape.size = {0.4, 0.3, 0.3};
    box.shape.cells.sites = 12;
    box.material = "concrete";
    return box;
}

Double3 directionBy(std::mt19937& random) {
    std::normal_distribution<double> along;
    const Double3 d = {along(random), along(random), along(random)};
    return (1 / sizeOf(d)) * d;
}

// Where many of its pieces lie in the ball's way: without those in front it would meet faces that are inside.
TEST(FirstBlows, StepsDoNotDecideHowHardABodyOfManyPiecesIsHit) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 8; ++trial) {
        const Double3 from = directionBy(random);
        BodyDescription shot = ball(1.3 * from, "");
        shot.velocity = -20.0 * from;
        shot.mass = 30;
        SceneDescription scene = sceneOf({boxOfPieces(), shot}, false);
        scene.effects = {"contacts", "impact_fracture", "events"};
        expectAlikeInStepsOfAnyLength(scene, 0.01, 0.05);
    }
}

TEST(FirstBlows, StepsDoNotDecideHowHardAVaseFalls) {
    const std::filesystem::path folder = support::sourceFolder() / "modules/brittle/scene/examples";
    auto scene = brittle::readScene(folder / "dropped_vase.toml");
    ASSERT_TRUE(scene);
    ASSERT_FALSE(scene->bodies[0].shape.file.empty());
    scene->bodies[0].shape.file = (folder / scene->bodies[0].shape.file).string();
    scene->effects.push_back("events");
    expectAlikeInStepsOfAnyLength(*scene, 0.01, 0.05);
}

// The pane is carried, and does not fall along with the ball.
TEST(FirstBlows, StepsDoNotDecideHowHardWhatLiesOnOthersIsHit) {
    std::vector<BodyDescription> bodies(3);
    for (size_t k : {0u, 1u}) {
        bodies[k].shape.size = {0.04, 0.2, 0.04};
        bodies[k].place = {k == 0 ? -0.14 : 0.14, 0.1, 0};
    }
    bodies[2].shape.size = {0.3, 0.006, 0.2};
    bodies[2].place = {0, 0.203, 0};
    bodies[2].material = "glass";
    for (const double height : {0.86, 0.9, 0.93}) {
        BodyDescription dropped = ball({0.02, height, 0.01}, "");
        dropped.shape.radius = 0.04;
        dropped.mass = 1;
        SceneDescription scene = sceneOf(bodies);
        scene.bodies.push_back(dropped);
        expectAlikeInStepsOfAnyLength(scene, 0.01, 0.05);
    }
}

// Within a step of 1/30 s both would; the slower one is nearer.
TEST(FirstBlows, OfTwoBodiesAreThoseOfTheOneThatComesFirst) {
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
        BodyDescription near = ball({-0.455, 0, 0}, ""), hard = ball({1.1, 0, 0}, "");
        near.velocity = {5, 0, 0};
        hard.velocity = {-15, 0, 0};
        SceneDescription scene = sceneOf({ball({0, 0, 0}, "glass"), near, hard}, false);
        scene.effects = {"contacts", "impact_fracture", "events"};
        scene.step.dt = dt;
        const auto world = worldOf(scene);
        const auto events = stepUntilItBreaks(*world, 60);
        ASSERT_EQ(events.size(), 1u) << dt;
        EXPECT_EQ(events[0].what.z, 1u) << dt;
        EXPECT_NEAR(events[0].blow.y, 5, 0.2) << dt << ", balls have facets";
    }
}

BodyDescription cube(const Double3& place, const char* material) {
    BodyDescription body;
    body.shape.size = {0.2, 0.2, 0.2};
    body.place = place;
    body.material = material;
    return body;
}

// Edge over edge, in every phase of the step. The planes of the faces that come towards each other do meet.
TEST(FirstBlows, NothingBreaksOnWhatItPassesBy) {
    constexpr double kClear = 0.003, kHeight = 0.2 * std::numbers::sqrt2 + kClear;
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120})
        for (const double ahead : {0.0, 0.02, 0.05, 0.09}) {
            BodyDescription flies = cube({-0.77 - ahead, kHeight, 0}, "ice"), stands = cube({0, 0, 0}, "");
            for (BodyDescription* body : {&flies, &stands})
                body->turn = {0, 0, std::sin(std::numbers::pi / 8), std::cos(std::numbers::pi / 8)};
            flies.velocity = {15, 0, 0};
            stands.mass = 50;
            SceneDescription scene = sceneOf({flies, stands}, false);
            scene.effects = {"contacts", "friction", "impact_fracture", "events"};
            scene.step.dt = dt;
            const auto world = worldOf(scene);
            EXPECT_TRUE(stepUntilItBreaks(*world, static_cast<uint32_t>(0.12 / dt)).empty()) << dt << ", " << ahead;
            EXPECT_NEAR((*world->bodies())[0].velocity.x, 15, 1e-4) << dt << ", " << ahead << ", bumps into nothing";
        }
}

// Also of what meets the wall just after a step is over, when the solver would brake it already.
TEST(FirstBlows, TakePlaceOnTheSurfaceThatIsMet) {
    constexpr double kDt = 1.0 / 120;
    for (const double speed : {5.0, 18.0})
        for (const double gap : {0.0002, 0.002, 0.005, 0.009, 0.012, 0.018}) {
            BodyDescription flies = cube({-0.1 - gap - 4 * kDt * speed, 0, 0}, "ice"), wall = cube({0.5, 0, 0}, "");
            flies.velocity = {speed, 0, 0};
            wall.shape.size = {1, 2, 2};
            wall.mass = 5000;
            SceneDescription scene = sceneOf({flies, wall}, false);
            scene.effects = {"contacts", "impact_fracture", "events"};
            scene.step.dt = kDt;
            const auto world = worldOf(scene);
            const auto events = stepUntilItBreaks(*world, 10);
            ASSERT_EQ(events.size(), 1u) << speed << ", " << gap;
            EXPECT_NEAR(SECTOR_EDGE * events[0].sector.x + double{events[0].offset.x}, 0, 1e-5) << speed << ", " << gap;
            EXPECT_NEAR(events[0].blow.y, speed, 1e-4 * speed) << speed << ", " << gap;
        }
}

} // namespace
