// What a world gives to be drawn, drawn: one indirect call of the engine's renderer, from the buffers that hosts get.
#include "engine/renderer.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/scene/scene_description.h"
#include "tests/engine/test_device.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

namespace {

using brittle::SceneDescription;

constexpr uint32_t kWidth = 320, kHeight = 240;

SceneDescription glassOnTheGround() {
    SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction", "impact_fracture", "events"};
    scene.budgets.pairs = 20000;
    brittle::BodyDescription cube;
    cube.material = "glass";
    cube.shape.size = {0.2, 0.2, 0.2};
    cube.place = {0, 0.6, 0};
    cube.turn = {0.3, 0.1, 0.2, 1};
    scene.bodies = {cube};
    scene.colliders.emplace_back();
    return scene;
}

std::unique_ptr<brittle::World> worldOf(const SceneDescription& scene) {
    brittle::WorldSurfaces surfaces;
    auto contents = brittle::contentsOf(scene, {}, nullptr, &surfaces);
    EXPECT_TRUE(contents);
    brittle::addLooks(*contents, surfaces);
    auto world =
        brittle::World::create(engine_test::device(), *contents, *brittle::settingsOf(scene), brittle::budgetOf(scene));
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

engine::Picture pictureOf(brittle::World& world, engine::Renderer& renderer) {
    EXPECT_TRUE(world.updateDraws({0, 0, 0}));
    const auto b = world.drawBuffers();
    EXPECT_TRUE(b);
    engine::Camera camera;
    camera.eye = {0.9f, 0.8f, 1.2f};
    camera.target = {0, 0.2f, 0};
    camera.near_plane = 0.05f;
    auto picture = renderer.draw({b->vertices, b->indices, b->commands, b->matrices, b->draw_count}, camera);
    EXPECT_TRUE(picture) << picture.error().message;
    return std::move(*picture);
}

size_t pixelsThatDiffer(const engine::Picture& a, const engine::Picture& b) {
    size_t count = 0;
    for (size_t k = 0; k + 3 < a.pixels.size(); k += 4)
        if (std::abs(a.pixels[k] - b.pixels[k]) > 12) ++count;
    return count;
}

// To be looked at, where somebody wants to.
void keep(const engine::Picture& picture, const char* name) {
    const char* folder = std::getenv("BRITTLE_PICTURES");
    if (folder == nullptr) return;
    EXPECT_TRUE(engine::writePng(picture, std::string(folder) + "/" + name));
}

TEST(DrawnWorld, ShowsFragmentsWhereTheCubeWas) {
    if (!engine_test::device().hasGraphics()) GTEST_SKIP() << "the device draws nothing";
    const auto world = worldOf(glassOnTheGround());
    auto renderer = engine::Renderer::create(engine_test::device(), kWidth, kHeight);
    ASSERT_TRUE(renderer) << renderer.error().message;
    const engine::Picture whole = pictureOf(*world, **renderer), again = pictureOf(*world, **renderer);
    EXPECT_EQ(pixelsThatDiffer(whole, again), 0u) << "nothing has happened";
    ASSERT_TRUE(world->step(15));
    const engine::Picture lower = pictureOf(*world, **renderer);
    EXPECT_GT(pixelsThatDiffer(whole, lower), 500u) << "it has fallen";
    ASSERT_TRUE(world->strike({{0, 0.3, 0}, 0.05, 200}));
    ASSERT_TRUE(world->step(25));
    ASSERT_FALSE(world->breaks()->events.empty());
    const engine::Picture broken = pictureOf(*world, **renderer);
    EXPECT_GT(pixelsThatDiffer(lower, broken), 500u) << "it is in pieces";
    keep(whole, "whole.png");
    keep(broken, "broken.png");
}

} // namespace
