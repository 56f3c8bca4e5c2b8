// Scenes that break rigid-body engines, at the usual settings, none of them tuned for its scene. What each has to fulfill
// stands with the scene (`brittle scenes NAME`); the numbers of the tests are those of the scenes.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using brittle::Double3;
using brittle::operator-;
using support::percentile;
using support::SceneRun;

double across(const Double3& v) { return std::hypot(v[0], v[2]); }
double sizeOf(const Double3& v) { return std::hypot(std::hypot(v[0], v[1]), v[2]); }

void staysAtRest(const std::string& name) {
    SceneRun run(name);
    double fastest = 0, furthest = 0;
    for (int part = 0; part < 10; ++part) {
        run.step(30);
        fastest = std::max(fastest, run.fastest());
        furthest = std::max(furthest, run.furthestWay());
    }
    EXPECT_LE(fastest, 1e-4);
    EXPECT_LE(furthest, 1e-4);
}

TEST(HardScenes, hard_01_block_100) { staysAtRest("hard_01_block_100"); }
TEST(HardScenes, hard_01_block_500) { staysAtRest("hard_01_block_500"); }
TEST(LongHardScenes, hard_01_block_2000) { staysAtRest("hard_01_block_2000"); }

void comesApartGently(const std::string& name) {
    SceneRun run(name);
    double fastest = 0;
    for (int step = 0; step < 120; ++step) {
        run.step(1);
        fastest = std::max(fastest, run.speed(0) + run.speed(1));
    }
    EXPECT_LE(run.speed(0) + run.speed(1), 0.05);
    EXPECT_LT(percentile(run.overlaps(), 1), 1e-3);
    EXPECT_LE(run.kineticEnergy(), 1e-3);
}

TEST(HardScenes, hard_03_overlap_1cm) { comesApartGently("hard_03_overlap_1cm"); }
TEST(HardScenes, hard_03_overlap_10cm) { comesApartGently("hard_03_overlap_10cm"); }

// The last third is the last five seconds.
void stands(const std::string& name, double lateral) {
    SceneRun run(name);
    run.step(600);
    EXPECT_EQ(run.world().counts()->awake, 0u);
    const size_t top = run.scene().bodies.size() - 1;
    const Double3 before = run.place(top);
    EXPECT_LE(across(run.way(top)), lateral);
    run.step(300);
    EXPECT_LE(across(run.way(top)), lateral);
    EXPECT_LE(sizeOf(run.place(top) - before), 1e-4);
}

TEST(HardScenes, hard_05_stack_10) { stands("hard_05_stack_10", 1e-3); }
TEST(HardScenes, hard_05_stack_20) { stands("hard_05_stack_20", 5e-3); }

TEST(LongHardScenes, hard_05_stack_40) { stands("hard_05_stack_40", 30e-3); }

double deepest(SceneRun& run) {
    run.finish();
    EXPECT_NEAR(run.place(1)[1], 1.5, 0.1) << "it does not stand";
    return percentile(run.overlaps(), 1);
}

TEST(HardScenes, hard_06_heavy_on_light_10) {
    SceneRun run("hard_06_heavy_on_light_10");
    EXPECT_LE(deepest(run), 3e-3);
}

TEST(HardScenes, hard_06_heavy_on_light_100) {
    SceneRun run("hard_06_heavy_on_light_100");
    EXPECT_LE(deepest(run), 10e-3);
}

void spinsFreely(const std::string& name) {
    SceneRun run(name);
    const gpu::BodyState before = run.state(0);
    const Double3 first = {before.momentum.x, before.momentum.y, before.momentum.z};
    const double energy = run.kineticEnergy();
    for (int part = 0; part < 10; ++part) {
        run.step(60);
        const Double3 now = run.angularMomentum();
        EXPECT_NEAR(sizeOf(now) / sizeOf(first), 1, 1e-4);
        const double cosine = (now[0] * first[0] + now[1] * first[1] + now[2] * first[2]) / (sizeOf(now) * sizeOf(first));
        EXPECT_LE(std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi, 0.1);
        EXPECT_NEAR(run.kineticEnergy() / energy, 1, 1e-3);
    }
}

TEST(HardScenes, hard_08_intermediate_axis) { spinsFreely("hard_08_intermediate_axis"); }
TEST(HardScenes, hard_09_thin_rod) { spinsFreely("hard_09_thin_rod"); }

// The wall stands at 5 m.
void stopsAtTheWall(const std::string& name, double speed) {
    SceneRun run(name);
    for (int step = 0; step < 120; ++step) {
        run.step(1);
        ASSERT_LT(run.place(0)[0], 5);
        if (step > 2) {
            ASSERT_GE(run.state(0).velocity.x, -0.01 * speed);
        }
    }
}

TEST(HardScenes, hard_10_wall_300) { stopsAtTheWall("hard_10_wall_300", 300); }
TEST(HardScenes, hard_10_wall_1000) { stopsAtTheWall("hard_10_wall_1000", 1000); }

void pushesThePlate(const std::string& name) {
    SceneRun run(name);
    const double before = run.momentum()[0];
    for (int step = 0; step < 120; ++step) {
        run.step(1);
        ASSERT_LT(run.place(0)[0], run.place(1)[0]) << "it went through";
    }
    EXPECT_NEAR(run.momentum()[0] / before, 1, 1e-6);
}

TEST(HardScenes, hard_11_plate_300) { pushesThePlate("hard_11_plate_300"); }
TEST(HardScenes, hard_11_plate_1000) { pushesThePlate("hard_11_plate_1000"); }

TEST(HardScenes, hard_13_head_on) {
    SceneRun run("hard_13_head_on");
    const float first = run.state(0).velocity.x, second = run.state(1).velocity.x;
    run.finish();
    EXPECT_NEAR(run.state(0).velocity.x / first, -1, 1e-3);
    EXPECT_NEAR(run.state(1).velocity.x / second, -1, 1e-3);
}

void liesFlat(const std::string& name, double thickness) {
    SceneRun run(name);
    run.finish();
    EXPECT_LE(percentile(run.overlaps(), 1), 0.1 * thickness);
    EXPECT_LE(run.fastest(), 1e-4);
}

TEST(HardScenes, hard_14_flat_plate_20mm) { liesFlat("hard_14_flat_plate_20mm", 0.02); }
TEST(HardScenes, hard_14_flat_plate_2mm) { liesFlat("hard_14_flat_plate_2mm", 0.002); }

TEST(HardScenes, hard_16_slope_55) {
    SceneRun run("hard_16_slope_55");
    run.step(300);
    const Double3 before = run.place(0);
    run.step(300);
    EXPECT_LE(sizeOf(run.place(0) - before), 1e-4);
}

TEST(HardScenes, hard_16_slope_45) {
    SceneRun run("hard_16_slope_45");
    run.finish();
    EXPECT_NEAR(sizeOf(run.way(0)), 22.36, 0.02 * 22.36);
}

// The highest that the middle comes after the bounce, above where it rests.
double apexOf(const std::string& name) {
    SceneRun run(name);
    double last = 1e9, apex = 0;
    bool risen = false;
    for (uint32_t step = 0; step < run.scene().step.steps; ++step) {
        run.step(1);
        const double y = run.place(0)[1] - 0.5;
        if (risen && y < last) break;
        risen = risen || y > last;
        if (risen) apex = std::max(apex, y);
        last = y;
    }
    return apex;
}

TEST(HardScenes, hard_17_bounce_100) { EXPECT_NEAR(apexOf("hard_17_bounce_100"), 2, 0.04); }
TEST(HardScenes, hard_17_bounce_50) { EXPECT_NEAR(apexOf("hard_17_bounce_50"), 0.5, 0.01); }

TEST(HardScenes, hard_19_far_100km) {
    SceneRun near("hard_19_far_0km"), far("hard_19_far_100km");
    near.step(300);
    far.step(300);
    for (size_t b = 0; b < near.scene().bodies.size(); ++b)
        EXPECT_LE(sizeOf(near.way(b) - far.way(b)), 1e-3);
}

} // namespace
