// Energy of motion and of height, step by step, while things break and after: contacts take it and hardly give any back.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/scene_file.h"
#include "tests/support/folders.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

namespace {

namespace fs = std::filesystem;

using brittle::BodyDescription, brittle::SceneDescription, brittle::ShapeKind;
using support::SceneRun;

// A contact is a soft spring: what presses it in comes back, in part. Of all that contacts and cracks have taken, what comes
// back in all steps together is less than balls with a restitution of 0.1 keep; in a step, of what was taken so far, as of
// 0.14. Before anything has met anything there is only rounding, and overlap of what is set down, which lifts it.
constexpr double kReturned = 0.14 * 0.14, kReturnedInAll = 0.1 * 0.1, kLifted = 1e-5; // m, a step
constexpr double kSunk = 0.2;     // of its size, of a center of mass below the ground in the end; the margin, until then
constexpr double kDensity = 2500; // kg/m3, about that of all that breaks here
constexpr double kFaster = 2;     // than before: what is light may be thrown off by what is heavy

double weightOf(const SceneRun& run) {
    double weight = 0;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        if (run.moves(b)) weight += brittle::length(run.scene().gravity) / double{run.state(b).offset.w};
    return weight;
}

double energyOf(const SceneRun& run) {
    double energy = run.kineticEnergy();
    for (size_t b = 0; b < run.bodyCount(); ++b)
        if (run.moves(b)) energy -= brittle::dot(run.scene().gravity, run.place(b)) / double{run.state(b).offset.w};
    return energy;
}

double lowestOf(const SceneRun& run) {
    double lowest = 1e9;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        if (run.moves(b)) lowest = std::min(lowest, run.place(b)[1]);
    return lowest;
}

// How far a center of mass lies below y = 0 at most, by the edge of the cube that weighs as much.
double deepestOf(const SceneRun& run) {
    double deepest = 0;
    for (size_t b = 0; b < run.bodyCount(); ++b)
        if (run.moves(b)) deepest = std::max(deepest, -run.place(b)[1] * std::cbrt(kDensity * double{run.state(b).offset.w}));
    return deepest;
}

// All stand on y = 0.
void expectSound(const SceneDescription& scene, uint32_t steps) {
    SceneRun run(scene);
    run.step(1);
    const double weight = weightOf(run), height = energyOf(run) / weight, first = energyOf(run);
    double last = first, least = first, fastest = 0, most = 0, all = 0;
    for (uint32_t step = 2; step <= steps; ++step) {
        run.step(1);
        ASSERT_TRUE(run.isFinite()) << step;
        const double energy = energyOf(run), rise = energy - last, bound = kReturned * (first - least) + kLifted * weight;
        EXPECT_LT(rise, bound) << "J, of " << first << ", step " << step;
        most = std::max(most, rise / bound);
        all += std::max(rise, 0.0);
        last = energy;
        least = std::min(least, energy);
        EXPECT_GT(lowestOf(run), -0.02) << step;
        const bool whole = run.world().counts()->broken == 0;
        if (whole) fastest = std::max(fastest, run.fastest());
        const double falling = 2 * brittle::length(scene.gravity) * std::max(height, 0.0);
        EXPECT_LT(run.fastest(), kFaster * std::sqrt(fastest * fastest + falling)) << step;
    }
    EXPECT_LT(deepestOf(run), kSunk);
    EXPECT_LT(all, kReturnedInAll * (first - least) + kLifted * weight * steps);
    std::printf("%s: %u broken, of %g J %g come back in all, in a step %.2g of what may\n", scene.name.c_str(),
                run.world().counts()->broken, first - last, all, most);
}

class Draw {
public:
    explicit Draw(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_()) % n; }

private:
    std::mt19937 random_;
};

BodyDescription thrown(Draw& draw, uint32_t k) {
    constexpr const char* kMaterials[] = {"glass", "porcelain", "concrete", "brick", "stone", ""};
    BodyDescription body;
    const double size = draw.between(0.1, 0.25);
    switch (draw.below(3)) {
    case 0:
        body.shape.kind = ShapeKind::Ball;
        body.shape.radius = size / 2;
        break;
    case 1:
        body.shape = {.kind = ShapeKind::Box, .size = {size, draw.between(0.6, 1) * size, draw.between(0.6, 1) * size}};
        break;
    default: body.shape = {.kind = ShapeKind::Box, .size = {2 * size, draw.between(0.05, 0.15) * size, 2 * size}};
    }
    body.material = kMaterials[draw.below(6)];
    if (body.material.empty()) body.density = 2500;
    body.place = {0.7 * (k % 3), 0.5 + 0.7 * (k / 3), draw.between(-0.05, 0.05)};
    body.turn = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
    body.velocity = {(k % 3 == 0 ? 1 : -1) * draw.between(0, 6), draw.between(-6, 1), 0};
    body.spin = {draw.between(-5, 5), draw.between(-5, 5), draw.between(-5, 5)};
    return body;
}

// Six balls, boxes and plates, thrown at the ground and at each other.
SceneDescription randomScene(uint32_t seed) {
    SceneDescription scene;
    scene.name = "random " + std::to_string(seed);
    scene.effects = {"gravity", "contacts", "friction", "impact_fracture"};
    scene.colliders.emplace_back();
    Draw draw(seed);
    for (uint32_t k = 0; k < 6; ++k)
        scene.bodies.push_back(thrown(draw, k));
    return scene;
}

SceneDescription example(const std::string& name) {
    const fs::path file = support::sourceFolder() / "modules" / "brittle" / "scene" / "examples" / (name + ".toml");
    auto scene = brittle::readScene(file);
    EXPECT_TRUE(scene);
    for (BodyDescription& body : scene->bodies)
        if (!body.shape.file.empty()) body.shape.file = (file.parent_path() / body.shape.file).string();
    return *scene;
}

TEST(QuickEnergyLedger, HardlyAnyComesBackWhereThingsBreak) {
    for (const char* name : {"window_pane", "wrecking_ball"})
        expectSound(example(name), 60);
    for (uint32_t seed = 1; seed <= 2; ++seed)
        expectSound(randomScene(seed), 60);
}

// Hundreds of splinters between the ground and each other, which a blow sets spinning at tens of thousands of radians a second.
TEST(QuickEnergyLedger, ThingsThatHitTheGroundAtAnySpeedLoseEnergyAllTheTime) {
    for (const double speed : {70., 300., 1000.}) {
        SceneDescription scene;
        scene.effects = {"gravity", "contacts", "friction", "impact_fracture"};
        scene.colliders.emplace_back();
        BodyDescription& cube = scene.bodies.emplace_back();
        cube.shape = {.kind = ShapeKind::Box, .size = {0.1, 0.1, 0.1}};
        cube.material = "glass";
        cube.place = {0, 1.81, 0};
        cube.velocity = {0, -speed, 0};
        SceneRun run(scene);
        run.step(1);
        double last = run.kineticEnergy();
        const double first = last;
        for (uint32_t step = 2; step <= 20; ++step) {
            run.step(1);
            ASSERT_TRUE(run.isFinite()) << speed << " m/s, step " << step;
            ASSERT_LT(run.kineticEnergy(), 1.01 * last + 1) << speed << " m/s, step " << step;
            last = run.kineticEnergy();
        }
        EXPECT_EQ(run.world().counts()->broken, 1u);
        EXPECT_LT(last, 0.5 * first) << speed << " m/s";
    }
}

TEST(LongEnergyLedger, HardlyAnyComesBackInTheExampleScenes) {
    for (const char* name : {"window_pane", "wrecking_ball", "ice_block", "dropped_vase", "ten_at_once", "quiet_shelf"})
        expectSound(example(name), 180);
}

TEST(LongEnergyLedger, HardlyAnyComesBackOfWhatIsThrown) {
    for (uint32_t seed = 1; seed <= 10; ++seed)
        expectSound(randomScene(seed), 150);
}

} // namespace
