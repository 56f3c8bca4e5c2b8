// A small world with every effect that there is, in which bodies break by a fall and by hand: for validation layers, which fail
// a test by their messages.
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/effects/effect_set.h"
#include "tests/module/small_pieces.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace small_pieces;
using breaking_scenes::worldOf;

std::vector<std::string> everyEffect() {
    std::vector<std::string> effects;
    for (const std::string_view name : brittle::kEffectNames)
        if (brittle::refusalOf(name).empty()) effects.emplace_back(name);
    return effects;
}

// Breaks from a hand's height into few pieces, and some of these are dust.
brittle::MaterialDescription chalk() {
    brittle::MaterialDescription material;
    material.name = "chalk";
    material.like = "brick";
    material.tensile_strength = 1e5;
    material.weibull_modulus = 1000;
    material.eta = 0.1;
    return material;
}

brittle::BodyDescription cube(double x, double height) {
    brittle::BodyDescription body;
    body.shape.size = {0.1, 0.1, 0.1};
    body.place = {x, height, 0};
    body.velocity = {0, -4, 0};
    body.material = "chalk";
    body.surface.restitution = 0.4;
    return body;
}

// Two cubes fall, the second a little later. A third one stands where it can be struck.
brittle::SceneDescription chalkThatFalls() {
    brittle::SceneDescription scene = breaking_scenes::sceneOf({cube(0, 0.06), cube(0.3, 0.3), cube(1, 0.05)});
    scene.effects = everyEffect();
    scene.bodies[2].velocity = {0, 0, 0};
    scene.materials.push_back(chalk());
    scene.breaking.smallest_piece = 0.03;
    scene.debris = {.below = 1, .after = 0.05, .fade = 0.05};
    scene.dust.lifetime = 0.1;
    scene.budgets.most_fragments = 8;
    scene.budgets.dust = 256;
    return scene;
}

// What the world has told since it began.
struct Told {
    uint32_t broken = 0, by_hand = 0, impacts = 0, particles = 0;
};

void hear(brittle::World& world, Told& told) {
    const auto breaks = world.breaks();
    const auto impacts = world.impacts();
    ASSERT_TRUE(breaks && impacts);
    for (const gpu::BreakEvent& event : breaks->events) {
        told.broken += event.made.x > 0 ? 1 : 0;
        told.by_hand += event.made.x > 0 && event.what.z == NO_INDEX ? 1 : 0;
    }
    told.impacts += static_cast<uint32_t>(impacts->events.size());
    told.particles += static_cast<uint32_t>(dustOf(world).flying.size());
}

Told told(brittle::World& world, uint32_t steps) {
    Told sum;
    for (uint32_t k = 0; k < steps; ++k) {
        const auto stepped = world.step();
        EXPECT_TRUE(stepped) << stepped.error().message;
        hear(world, sum);
    }
    return sum;
}

} // namespace

TEST(SmallAllEffects, BreakBodiesThatFall) {
    const auto world = worldOf(chalkThatFalls());
    const Told sum = told(*world, 40);
    const brittle::WorldCounts counts = countsOf(*world);
    EXPECT_GE(sum.broken, 2u);
    EXPECT_EQ(sum.by_hand, 0u);
    EXPECT_GT(counts.fragments, 3u);
    EXPECT_GT(counts.expired, 0u) << "debris that has had its time";
    EXPECT_GT(sum.impacts, 0u);
    EXPECT_GT(sum.particles, 0u) << "of dust";
    EXPECT_EQ(counts.pool_faults, 0u);
}

// As few steps as can be, for GPU-assisted validation.
TEST(SmallAllEffects, BreakABodyAtOnce) {
    const auto world = worldOf(chalkThatFalls());
    EXPECT_FALSE(breaking_scenes::stepUntilItBreaks(*world, 3).empty());
    EXPECT_GT(countsOf(*world).fragments, 1u);
}

TEST(SmallAllEffects, BreakABodyThatIsStruckByHand) {
    const auto world = worldOf(chalkThatFalls());
    ASSERT_TRUE(world->strike({.place = {1, 0.12, 0}, .radius = 0.05, .energy = 50}));
    const Told sum = told(*world, 10);
    EXPECT_GE(sum.by_hand, 1u);
    EXPECT_GT(sum.particles, 0u) << "of dust";
    EXPECT_EQ(countsOf(*world).pool_faults, 0u);
}
