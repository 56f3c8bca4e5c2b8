// Panes in worlds: held in place until they break, and broken in spokes and rings.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/scene/check_scene.h"
#include "tests/module/breaking_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::SceneDescription, brittle::Double3;
using brittle::operator+, brittle::operator*;

constexpr double kEdge = 1, kThickness = 0.004; // m

// Hit from below, in empty space, off its middle.
SceneDescription paneAndBall(brittle::BreakPattern pattern, bool fixed, double speed = 20) {
    BodyDescription pane;
    pane.shape.size = {kEdge, kThickness, kEdge};
    pane.material = "glass";
    pane.break_pattern = pattern;
    pane.fixed = fixed;
    BodyDescription thrown = ball({0.1, -0.1, 0.05}, "");
    thrown.shape.radius = 0.02;
    thrown.mass = 0.05;
    thrown.velocity = {0, speed, 0};
    SceneDescription scene = sceneOf({pane, thrown}, false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    return scene;
}

std::vector<brittle::SurfaceMesh> surfacesOf(brittle::World& world, const std::vector<brittle::BodyFragment>& fragments) {
    auto surfaces = world.surfacesOf(fragments);
    EXPECT_TRUE(surfaces);
    return std::move(*surfaces);
}

// In the world, as they were made.
std::vector<std::vector<Double3>> cornersOf(brittle::World& world) {
    const auto fragments = world.fragments();
    const auto states = world.bodies();
    EXPECT_TRUE(fragments && states);
    std::vector<std::vector<Double3>> all;
    const auto surfaces = surfacesOf(world, *fragments);
    for (size_t k = 0; k < fragments->size(); ++k) {
        const brittle::Pose pose = brittle::poseOf((*states)[(*fragments)[k].slot]);
        all.emplace_back();
        for (const auto& vertex : surfaces[k].vertices)
            all.back().push_back(pose.place + brittle::turnedBy(pose.turn, brittle::positionOf(vertex)));
    }
    return all;
}

TEST(FixedBodies, DoNotMoveUntilTheyBreak) {
    SceneDescription scene = paneAndBall(brittle::BreakPattern::Impact, true, 0.05);
    scene.effects.push_back("gravity");
    const auto world = worldOf(scene);
    step(*world, 30);
    EXPECT_TRUE(world->breaks()->events.empty());
    EXPECT_EQ(presentBodies(*world).size(), 1u) << "the ball";
}

TEST(FixedBodies, BreakIntoFragmentsThatWeighWhatTheyDoAndFallFromRest) {
    SceneDescription scene = paneAndBall(brittle::BreakPattern::Impact, true);
    const auto world = worldOf(scene);
    const auto events = stepUntilItBreaks(*world, 30);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_GT(events[0].made.x, 10u);
    const auto bodies = presentBodies(*world);
    EXPECT_EQ(bodies.size(), events[0].made.x + 1u);
    EXPECT_NEAR(massOf(bodies), 0.05 + 2500 * kEdge * kEdge * kThickness, 1e-3);
    double lost = 0.5 * 0.05 * 20 * 20;
    for (const gpu::BodyState& body : bodies) {
        const bool is_ball = std::fabs(1 / body.offset.w - 0.05f) < 1e-6f && body.velocity.y > 1;
        if (is_ball)
            lost -= 0.5 * 0.05 * double{body.velocity.y} * double{body.velocity.y};
        else {
            EXPECT_EQ(sizeOf(vectorOf(body.velocity)), 0) << "at rest, as the pane was";
        }
    }
    EXPECT_NEAR(lost, events[0].energies.z, 1e-3 * lost) << "the ball pays for all cracks";
    step(*world, 10);
    double moved = 0;
    for (const gpu::BodyState& body : presentBodies(*world))
        moved = std::max(moved, sizeOf(vectorOf(body.velocity)));
    EXPECT_GT(moved, 0.1);
}

Double3 placeOf(const gpu::BreakEvent& event) {
    return {double{event.offset.x} + SECTOR_EDGE * event.sector.x, double{event.offset.y} + SECTOR_EDGE * event.sector.y,
            double{event.offset.z} + SECTOR_EDGE * event.sector.z};
}

double angleAbout(const Double3& blow, const Double3& p) { return std::atan2(p[2] - blow[2], p[0] - blow[0]); }

TEST(FixedBodies, AreRefusedAVelocity) {
    SceneDescription scene = paneAndBall(brittle::BreakPattern::Impact, true);
    EXPECT_TRUE(brittle::checkScene(scene));
    scene.bodies[0].velocity = {0, 1, 0};
    const auto checked = brittle::checkScene(scene);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().message.find("is 'fixed' and has a 'velocity' or a 'spin'"), std::string::npos)
        << checked.error().message;
}

// The widest angle that a fragment takes up, seen from the blow; of its corners there none can be told.
double widthOf(const std::vector<Double3>& corners, const Double3& blow) {
    Double3 middle = {0, 0, 0};
    for (const Double3& p : corners)
        middle = middle + (1 / static_cast<double>(corners.size())) * p;
    double low = 0, high = 0;
    for (const Double3& p : corners) {
        if (std::hypot(p[0] - blow[0], p[2] - blow[2]) < 0.005) continue;
        const double turn = std::remainder(angleAbout(blow, p) - angleAbout(blow, middle), 2 * std::numbers::pi);
        low = std::min(low, turn);
        high = std::max(high, turn);
    }
    return high - low;
}

bool reachesRim(const std::vector<Double3>& corners) {
    return std::ranges::any_of(corners,
                               [](const Double3& p) { return std::max(std::fabs(p[0]), std::fabs(p[2])) > kEdge / 2 - 1e-4; });
}

TEST(RadialPattern, HasSpokesToTheRimAndRingsBetween) {
    for (const double speed : {14.0, 20.0}) {
        const auto world = worldOf(paneAndBall(brittle::BreakPattern::Radial, false, speed));
        const auto events = stepUntilItBreaks(*world, 60);
        ASSERT_EQ(events.size(), 1u);
        const double spokes = std::floor(2 * std::sqrt(double{events[0].blow.y}));
        size_t at_rim = 0;
        const auto all = cornersOf(*world);
        for (const auto& corners : all) {
            at_rim += reachesRim(corners) ? 1 : 0;
            EXPECT_LT(widthOf(corners, placeOf(events[0])), 1.6 * 2 * std::numbers::pi / spokes) << "across a spoke";
        }
        EXPECT_GE(at_rim, spokes);
        EXPECT_GE(all.size(), 2 * spokes) << "rings";
        EXPECT_NEAR(events[0].energies.z / events[0].blow.z, 1, 0.15) << "cracks cost what is theirs";
    }
}

// Where the finest rings cost less than what is paid for, more spokes do; where there is no room for so many, the event says
// so.
TEST(RadialPattern, TakesMoreSpokesOnceRingsAreFineEnough) {
    for (const double speed : {10.0, 14.0, 18.0})
        for (const uint32_t most : {40u, 1000u}) {
            SceneDescription scene = paneAndBall(brittle::BreakPattern::Radial, false, speed);
            scene.materials = {{"fine glass", "glass"}};
            scene.materials[0].eta = 0.2;
            scene.bodies[0].material = "fine glass";
            brittle::WorldBudget budget;
            budget.breaking.most_fragments = most;
            budget.breaking.step_sites = budget.breaking.fragments = 1024;
            const auto world = worldOf(scene, budget);
            const auto events = stepUntilItBreaks(*world, 60);
            ASSERT_EQ(events.size(), 1u);
            const double paid_for = events[0].along.w, share = events[0].energies.z / events[0].blow.z;
            EXPECT_GT(paid_for, 60) << speed;
            EXPECT_LT(paid_for, 1000) << speed;
            if (most < paid_for)
                EXPECT_LE(events[0].made.x, most) << speed;
            else
                EXPECT_NEAR(share, 1, 0.15) << speed << ": cracks cost what is theirs";
        }
}

TEST(RadialPattern, OfAPaneStruckByHandCostsWhatTheBlowPaysFor) {
    SceneDescription scene = paneAndBall(brittle::BreakPattern::Radial, false);
    scene.bodies.resize(1);
    for (const double joules : {8.0, 20.0}) {
        const auto world = worldOf(scene);
        ASSERT_TRUE(world->strike({{0.1, -0.02, 0.05}, 0.02, joules}));
        const auto events = stepUntilItBreaks(*world, 2);
        ASSERT_EQ(events.size(), 1u);
        EXPECT_NEAR(events[0].energies.z / events[0].blow.z, 1, 0.15) << joules;
    }
}

std::set<uint64_t> hashesOfRuns(const SceneDescription& scene) {
    std::set<uint64_t> hashes;
    for (int run = 0; run < 2; ++run) {
        const auto world = worldOf(scene);
        EXPECT_EQ(stepUntilItBreaks(*world, 60).size(), 1u);
        hashes.insert(*world->hash());
    }
    return hashes;
}

TEST(RadialPattern, IsTheSameInEveryRun) {
    EXPECT_EQ(hashesOfRuns(paneAndBall(brittle::BreakPattern::Radial, true)).size(), 1u);
}

// Of the centers of mass of what broke from the place of the blow, in the step that it broke in.
struct Broken {
    gpu::BreakEvent event;
    double mass = 0, distance = 0; // mean
};

Broken brokenBy(brittle::BreakPattern pattern, double speed) {
    SceneDescription scene = shot(speed, "concrete");
    scene.bodies[0].break_pattern = pattern;
    const auto world = worldOf(scene);
    const auto events = stepUntilItBreaks(*world, 60);
    EXPECT_EQ(events.size(), 1u);
    Broken all{events[0], massOf(presentBodies(*world)), 0};
    const auto fragments = world->fragments();
    const auto states = world->bodies();
    for (const auto& f : *fragments)
        all.distance += sizeOf(brittle::poseOf((*states)[f.slot]).place + (-1.0) * placeOf(events[0])) /
                        static_cast<double>(fragments->size());
    return all;
}

TEST(PaperPattern, OfAWorldDrawsFragmentsToTheBlowAndKeepsMass) {
    const Broken paper = brokenBy(brittle::BreakPattern::Paper, 12), even = brokenBy(brittle::BreakPattern::Uniform, 12);
    EXPECT_GT(paper.event.made.x, 8u);
    EXPECT_LT(paper.distance, 0.85 * even.distance);
    EXPECT_NEAR(paper.mass, even.mass, 1e-5 * even.mass);
    EXPECT_GE(paper.event.energies.x - paper.event.energies.y, 0.999f * paper.event.energies.z) << "cracks are paid for";
}

TEST(PaperPattern, OfAWorldIsTheSameInEveryRun) {
    SceneDescription scene = paneAndBall(brittle::BreakPattern::Paper, false);
    EXPECT_EQ(hashesOfRuns(scene).size(), 1u);
}

TEST(RadialPattern, OfWhatIsNoPlateIsThatOfABlow) {
    std::vector<gpu::BreakEvent> events;
    for (const auto pattern : {brittle::BreakPattern::Impact, brittle::BreakPattern::Radial}) {
        SceneDescription scene = shot(8, "concrete");
        scene.bodies[0].break_pattern = pattern;
        const auto world = worldOf(scene);
        const auto found = stepUntilItBreaks(*world, 30);
        ASSERT_EQ(found.size(), 1u);
        events.push_back(found[0]);
    }
    EXPECT_EQ(events[0].made.x, events[1].made.x);
    EXPECT_EQ(events[0].energies.w, events[1].energies.w);
}

} // namespace
