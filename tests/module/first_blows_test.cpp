// What breaks a body is what meets it first: of its own pieces, which lie behind each other, and of several bodies.
#include "modules/brittle/scene/scene_file.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <filesystem>
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
    const std::filesystem::path folder = std::filesystem::path(BRITTLE_SOURCE_DIR) / "modules/brittle/scene/examples";
    auto scene = brittle::readScene(folder / "dropped_vase.toml");
    ASSERT_TRUE(scene);
    ASSERT_FALSE(scene->bodies[0].shape.file.empty());
    scene->bodies[0].shape.file = (folder / scene->bodies[0].shape.file).string();
    scene->effects.push_back("events");
    expectAlikeInStepsOfAnyLength(*scene, 0.01, 0.05);
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

} // namespace
