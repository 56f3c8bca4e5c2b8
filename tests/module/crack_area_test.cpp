// Worlds in which things of many sizes are hit softly and hard: what their cracks cost is the share of the blow that is theirs.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/effects/fragment_count.h"
#include "modules/brittle/scene/body_shape.h"
#include "tests/engine/test_device.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace {

using brittle::BodyDescription, brittle::SceneDescription, brittle::ShapeKind;

struct Target {
    brittle::ShapeDescription shape;
    std::string material;
    double half_depth = 0; // m, towards what hits it
    brittle::BreakPattern pattern = brittle::BreakPattern::Impact;
    brittle::Double3 off = {0, 0, 0}; // of its middle, from where it is hit
    double room = 1;                  // sites for what the law of a square that is hit about its middle asks for
};

Target brokenBy(brittle::BreakPattern pattern, Target target, brittle::Double3 off = {0, 0, 0}) {
    target.pattern = pattern;
    target.off = off;
    if (pattern == brittle::BreakPattern::Radial) target.room = 1.2; // rings have sites beyond the rim
    return target;
}

Target cubeOf(double edge, const char* material) {
    Target target{{}, material, edge / 2};
    target.shape.size = {edge, edge, edge};
    return target;
}

Target ballOf(double radius, const char* material) {
    Target target{{}, material, radius};
    target.shape.kind = ShapeKind::Ball;
    target.shape.radius = radius;
    return target;
}

Target paneOf(double edge, double thickness) {
    Target target{{}, "glass", thickness / 2};
    target.shape.size = {edge, edge, thickness};
    return target;
}

Target slabOf(double length, double width, double thickness, double off) {
    Target target{{}, "glass", thickness / 2};
    target.shape.size = {length, width, thickness};
    target.off = {off, 0, 0};
    target.room = 2;
    return target;
}

brittle::BodyForm formOf(const Target& target) {
    const auto hull = brittle::hullOf(target.shape, {});
    double area = 0;
    for (const brittle::ConvexHull::Face& face : hull->hull.faces)
        for (uint32_t k = 2; k < face.corner_count; ++k) {
            const auto corner = [&](uint32_t c) { return hull->hull.vertices[hull->hull.corners[face.first_corner + c]]; };
            const auto from = corner(0), a = corner(k - 1), b = corner(k);
            Eigen::Vector3d u, v;
            for (int c = 0; c < 3; ++c) {
                u[c] = a[size_t(c)] - from[size_t(c)];
                v[c] = b[size_t(c)] - from[size_t(c)];
            }
            area += u.cross(v).norm() / 2;
        }
    return brittle::formOf(hull->measures.volume, area);
}

brittle::Spread spreadOf(brittle::BreakPattern pattern) {
    return pattern == brittle::BreakPattern::Paper ? brittle::Spread::Paper : brittle::Spread::AboutBlow;
}

constexpr double kFast = 10; // m/s, which breaks all of them

// So many of them, far apart in empty space, each about to be hit by a ball with the energy that the law asks for so many
// fragments (in spokes and rings, about the blow): the ball is as heavy as the target, or lighter where that would be slow.
SceneDescription hits(const Target& target, uint32_t copies, double fragments) {
    const brittle::Material& material = *brittle::findMaterial(target.material);
    const brittle::BodyForm form = formOf(target);
    const double mass = material.density * form.volume, far = 20 * form.side;
    const double joules = brittle::energyForFragments(material, form, fragments, spreadOf(target.pattern));
    const double speed = std::max(kFast, std::sqrt(4 * joules / mass)), meets = 2 * joules / (speed * speed);
    SceneDescription scene;
    scene.effects = {"contacts", "impact_fracture", "events"};
    for (uint32_t k = 0; k < copies; ++k) {
        BodyDescription body, ball;
        body.shape = target.shape;
        body.material = target.material;
        body.break_pattern = target.pattern;
        body.place = {far * k + target.off[0], target.off[1], target.off[2]};
        ball.shape.kind = ShapeKind::Ball;
        ball.shape.radius = 0.15 * form.side;
        ball.mass = meets / (1 - meets / mass);
        ball.place = {far * k, 0, -target.half_depth - 1.1 * ball.shape.radius};
        ball.velocity = {0, 0, speed};
        scene.bodies.push_back(body);
        scene.bodies.push_back(ball);
    }
    return scene;
}

brittle::WorldBudget roomFor(uint32_t copies, double fragments) {
    brittle::WorldBudget budget;
    const auto sites = static_cast<uint32_t>(1.2 * fragments + 20);
    budget.breaking.most_fragments = sites;
    budget.breaking.step_bodies = copies;
    budget.breaking.step_sites = budget.breaking.fragments = copies * sites;
    return budget;
}

std::vector<gpu::BreakEvent> breaksOf(const SceneDescription& scene, const brittle::WorldBudget& budget) {
    const auto contents = brittle::contentsOf(scene, {}, nullptr);
    const auto settings = brittle::settingsOf(scene);
    EXPECT_TRUE(contents && settings);
    auto world = brittle::World::create(engine_test::device(), *contents, *settings, budget);
    EXPECT_TRUE(world) << world.error().message;
    for (uint32_t step = 0; step < 60; ++step) {
        const auto done = (*world)->step(1);
        EXPECT_TRUE(done) << done.error().message;
        const auto breaks = (*world)->breaks();
        if (!breaks->events.empty()) return breaks->events;
    }
    return {};
}

struct Measured {
    double afforded = 0, spent = 0; // J
    double fragments = 0;           // of each
};

Measured measure(const Target& target, uint32_t copies, double fragments) {
    Measured sum;
    const auto events = breaksOf(hits(target, copies, fragments), roomFor(copies, target.room * fragments));
    EXPECT_EQ(events.size(), copies);
    for (const gpu::BreakEvent& event : events) {
        sum.afforded += double{event.blow.z};
        sum.spent += brittle::findMaterial(target.material)->fracture_energy * double{event.energies.w};
        sum.fragments += event.made.x / static_cast<double>(copies);
    }
    return sum;
}

struct Hit {
    Target target;
    uint32_t copies;
    double fragments;
};

// Over three decades of energy.
void expectCracksToCostTheirShare(const std::vector<Hit>& all) {
    double least = 1e30, most = 0;
    for (const Hit& hit : all) {
        const Measured found = measure(hit.target, hit.copies, hit.fragments);
        EXPECT_NEAR(found.spent / found.afforded, 1, 0.15) << hit.fragments << " of " << hit.target.half_depth;
        const brittle::Material& card = *brittle::findMaterial(hit.target.material);
        const double joules = found.afforded / hit.copies / card.eta;
        const double expected = brittle::expectedFragments(card, formOf(hit.target), joules, spreadOf(hit.target.pattern));
        if (hit.target.room == 1) {
            EXPECT_NEAR(found.fragments / expected, 1, 0.2);
        }
        least = std::min(least, found.afforded / hit.copies);
        most = std::max(most, found.afforded / hit.copies);
    }
    EXPECT_GT(most / least, 1000);
}

TEST(CrackArea, OfCubesIsWhatTheBlowPaysFor) {
    expectCracksToCostTheirShare({{cubeOf(0.1, "concrete"), 24, 3},
                                  {cubeOf(0.1, "concrete"), 12, 12},
                                  {cubeOf(0.3, "concrete"), 12, 12},
                                  {cubeOf(0.3, "concrete"), 4, 60},
                                  {cubeOf(1, "concrete"), 2, 200},
                                  {cubeOf(1, "concrete"), 1, 1000}});
}

TEST(CrackArea, OfBallsIsWhatTheBlowPaysFor) {
    expectCracksToCostTheirShare({{ballOf(0.02, "porcelain"), 24, 3},
                                  {ballOf(0.05, "porcelain"), 12, 10},
                                  {ballOf(0.1, "porcelain"), 4, 60},
                                  {ballOf(0.2, "porcelain"), 2, 250},
                                  {ballOf(0.25, "porcelain"), 1, 1000}});
}

TEST(CrackArea, OfPanesIsWhatTheBlowPaysFor) {
    expectCracksToCostTheirShare({{paneOf(0.12, 0.004), 24, 3},
                                  {paneOf(0.3, 0.004), 12, 12},
                                  {paneOf(0.6, 0.004), 6, 40},
                                  {paneOf(1, 0.006), 3, 150},
                                  {paneOf(1.8, 0.012), 1, 1000}});
}

// Hit in the middle, halfway to an end, and at an end.
TEST(CrackArea, OfOblongPanesIsWhatTheBlowPaysFor) {
    expectCracksToCostTheirShare({{slabOf(0.3, 0.1, 0.004, 0), 24, 3},
                                  {slabOf(0.3, 0.1, 0.004, 0.135), 24, 3},
                                  {slabOf(1.2, 0.2, 0.006, 0.3), 12, 12},
                                  {slabOf(1.5, 0.2, 0.008, 0.7), 12, 12},
                                  {slabOf(1.5, 0.2, 0.008, 0), 4, 60},
                                  {slabOf(2, 0.4, 0.008, 0.9), 2, 200},
                                  {slabOf(5, 1, 0.02, 1.2), 1, 500}});
}

using brittle::BreakPattern, brittle::Double3;

TEST(CrackArea, OfCubesThatBreakAsInThePaperIsWhatTheBlowPaysFor) {
    const auto paper = [](double edge) { return brokenBy(BreakPattern::Paper, cubeOf(edge, "concrete")); };
    expectCracksToCostTheirShare({{paper(0.1), 24, 3},
                                  {paper(0.1), 12, 12},
                                  {paper(0.3), 12, 12},
                                  {paper(0.3), 4, 60},
                                  {paper(1), 2, 200},
                                  {paper(1), 1, 1000}});
}

TEST(CrackArea, OfPanesThatBreakAsInThePaperIsWhatTheBlowPaysFor) {
    const auto paper = [](double edge, double thickness) { return brokenBy(BreakPattern::Paper, paneOf(edge, thickness)); };
    expectCracksToCostTheirShare({{paper(0.12, 0.004), 24, 3},
                                  {paper(0.3, 0.004), 12, 12},
                                  {paper(0.6, 0.004), 6, 40},
                                  {paper(1, 0.006), 3, 150},
                                  {paper(3, 0.016), 1, 1000}});
}

TEST(CrackArea, OfPanesThatBreakInSpokesAndRingsIsWhatTheBlowPaysFor) {
    const auto radial = [](double edge, double thickness) { return brokenBy(BreakPattern::Radial, paneOf(edge, thickness)); };
    expectCracksToCostTheirShare({{radial(0.12, 0.004), 24, 3},
                                  {radial(0.3, 0.004), 24, 12},
                                  {radial(0.6, 0.004), 12, 40},
                                  {radial(1, 0.006), 4, 150},
                                  {radial(1.8, 0.012), 1, 1000}});
}

void expectShareWhereverHit(BreakPattern pattern, double room) {
    for (const double fragments : {12.0, 40.0, 120.0}) {
        const auto copies = static_cast<uint32_t>(250 / (fragments + 5));
        for (const Double3& off : {Double3{0.16, 0.08, 0}, Double3{0.36, 0, 0}, Double3{0.36, 0.36, 0}}) {
            Target target = brokenBy(pattern, paneOf(0.8, 0.004), off);
            target.room = room;
            const Measured found = measure(target, copies, fragments);
            EXPECT_NEAR(found.spent / found.afforded, 1, 0.15) << fragments << " at " << off[0] << ", " << off[1];
        }
    }
}

TEST(CrackArea, OfPanesInSpokesAndRingsIsWhatTheBlowPaysForWhereverItIs) { expectShareWhereverHit(BreakPattern::Radial, 4); }
TEST(CrackArea, OfPanesAsInThePaperIsWhatTheBlowPaysForWhereverItIs) { expectShareWhereverHit(BreakPattern::Paper, 1.5); }

TEST(CrackArea, IsLessWhereTheBudgetOfABodyEndsAndTheHostIsTold) {
    const Target pane = paneOf(1, 0.004);
    brittle::WorldBudget budget = roomFor(1, 200);
    budget.breaking.most_fragments = 50;
    const auto events = breaksOf(hits(pane, 1, 200), budget);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_LE(events[0].made.x, 50u);
    EXPECT_NEAR(events[0].along.w, 200, 20);
    EXPECT_LT(events[0].energies.w * 7.7f, 0.6f * events[0].blow.z);
}

} // namespace
