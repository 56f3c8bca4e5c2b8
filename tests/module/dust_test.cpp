// Cells that are too small to be bodies, with the effect `dust` and without.
#include "modules/brittle/mesh/vector_math.h"
#include "tests/module/small_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

namespace {

using breaking_scenes::ball, breaking_scenes::worldOf, breaking_scenes::step, breaking_scenes::presentBodies,
    breaking_scenes::motionOf, breaking_scenes::vectorOf, breaking_scenes::Motion, breaking_scenes::kBall;
using brittle::Double3, brittle::operator+, brittle::operator-, brittle::operator*, brittle::dot, brittle::cross,
    brittle::length;
using small_pieces::sceneOf, small_pieces::shot, small_pieces::firstBreaks, small_pieces::dustOf, small_pieces::motionOf,
    small_pieces::placeOf, small_pieces::countsOf;

// m: of the cells of the ball of `shot`, some are smaller and some are not; all are smaller.
constexpr double kSome = 0.05, kAll = 1;

brittle::SceneDescription withSmallest(brittle::SceneDescription scene, double smallest) {
    scene.breaking.smallest_piece = smallest;
    return scene;
}

void expectAmount(const brittle::DustAmount& amount, const brittle::DustAmount& expected) {
    EXPECT_EQ(amount.particles, expected.particles);
    EXPECT_EQ(amount.mass, expected.mass) << "to the last grain";
}

// ---- what is no body ------------------------------------------------------------------------------------------------------

TEST(Dust, MassOfCellsThatAreNoBodiesIsTold) {
    for (const bool flies : {false, true}) {
        const auto world =
            worldOf(withSmallest(shot(flies ? std::vector<std::string>{"dust"} : std::vector<std::string>{}), kSome));
        const double mass = motionOf(presentBodies(*world)).mass;
        const auto events = firstBreaks(*world);
        ASSERT_EQ(events.size(), 1u);
        const double dust = events[0].offset.w;
        const auto bodies = presentBodies(*world);
        EXPECT_GT(events[0].made.x, 0u);
        EXPECT_GT(events[0].sector.w, 0);
        EXPECT_EQ(bodies.size(), events[0].made.x + 1);
        EXPECT_GT(dust, 0.005 * mass);
        EXPECT_NEAR(motionOf(bodies).mass + dust, mass, 1e-6 * mass);
        EXPECT_EQ(dustOf(*world).flying.empty(), !flies);
    }
}

TEST(Dust, CellsThatAreNoBodiesAskForNoRoom) {
    const auto world = worldOf(withSmallest(shot(), kSome));
    const auto before = countsOf(*world).in_use;
    const auto events = firstBreaks(*world);
    ASSERT_EQ(events.size(), 1u);
    const auto after = countsOf(*world);
    EXPECT_EQ(after.in_use[POOL_BODIES], before[POOL_BODIES] - 1 + events[0].made.x);
    EXPECT_EQ(after.in_use[POOL_PIECES], before[POOL_PIECES] - 1 + events[0].made.x);
    EXPECT_EQ(after.fragments, events[0].made.x);
    EXPECT_EQ(after.pool_faults, 0u);
}

TEST(Dust, WhereNoCellIsABodyTheBodyGoesAllTheSame) {
    const auto world = worldOf(withSmallest(shot({"dust"}), kAll));
    const Motion before = motionOf(presentBodies(*world));
    const auto events = firstBreaks(*world);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].made.x, 0u);
    EXPECT_GT(events[0].sector.w, 2);
    const auto bodies = presentBodies(*world);
    ASSERT_EQ(bodies.size(), 1u);
    EXPECT_NEAR(motionOf(bodies).mass + double{events[0].offset.w}, before.mass, 1e-6 * before.mass);
    EXPECT_EQ(countsOf(*world).broken, 1u);
    EXPECT_EQ(countsOf(*world).in_use[POOL_BODIES], 1u);
    EXPECT_TRUE(world->fragments()->empty());
}

// ---- particles ------------------------------------------------------------------------------------------------------------

TEST(Dust, KeepsMassAndMomentum) {
    for (const double smallest : {kSome, kAll}) {
        const auto world = worldOf(withSmallest(shot({"dust"}), smallest));
        const Motion before = motionOf(presentBodies(*world));
        const auto events = firstBreaks(*world);
        ASSERT_EQ(events.size(), 1u);
        const Motion bodies = motionOf(presentBodies(*world)), dust = motionOf(dustOf(*world).flying);
        EXPECT_NEAR(bodies.mass + dust.mass, before.mass, 1e-6 * before.mass);
        EXPECT_NEAR(dust.mass, double{events[0].offset.w}, 1e-6 * dust.mass);
        EXPECT_LT(length(bodies.momentum + dust.momentum - before.momentum), 1e-6 * length(before.momentum));
    }
}

TEST(Dust, BeginsAsTheBodyMovedThere) {
    const auto world = worldOf(withSmallest(shot({"dust"}), kAll));
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    const auto particles = dustOf(*world).flying;
    ASSERT_GT(particles.size(), 10u);
    double fastest = 0;
    for (const gpu::DustParticle& a : particles)
        for (const gpu::DustParticle& b : particles) {
            const Double3 apart = placeOf(b) - placeOf(a), faster = vectorOf(b.velocity) - vectorOf(a.velocity);
            EXPECT_LT(std::abs(dot(apart, faster)), 1e-5 * (length(apart) + 0.01)) << "a body that turns keeps its distances";
            fastest = std::max(fastest, length(faster));
        }
    EXPECT_GT(fastest, 0.1) << "it did turn";
}

// A cell, as it is where every cell is a body.
struct Cell {
    double mass = 0;
    Double3 place, momentum;
    std::vector<std::array<Double3, 3>> triangles; // in the world
    double dust = 0;
    Double3 dust_place = {0, 0, 0}, dust_momentum = {0, 0, 0};
};

std::vector<Cell> cellsOf(brittle::World& world) {
    std::vector<Cell> cells;
    const auto fragments = world.fragments();
    const auto surfaces = world.surfacesOf(*fragments);
    const auto states = world.bodies();
    for (size_t k = 0; k < fragments->size(); ++k) {
        const gpu::BodyState& state = (*states)[(*fragments)[k].slot];
        const brittle::Pose pose = brittle::poseOf(state);
        Cell& cell = cells.emplace_back();
        cell.mass = 1.0 / state.offset.w;
        cell.place = pose.place;
        cell.momentum = cell.mass * vectorOf(state.velocity);
        const brittle::SurfaceMesh& surface = (*surfaces)[k];
        for (size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
            std::array<Double3, 3> corners;
            for (size_t c = 0; c < 3; ++c)
                corners[c] =
                    pose.place + brittle::turnedBy(pose.turn, brittle::positionOf(surface.vertices[surface.indices[t + c]]));
            cell.triangles.push_back(corners);
        }
    }
    return cells;
}

// m, at the most, that the place lies outside of a convex cell.
double outside(const Cell& cell, const Double3& place) {
    double furthest = -1e9;
    for (const auto& [a, b, c] : cell.triangles) {
        const Double3 normal = cross(b - a, c - a);
        if (length(normal) > 1e-12) furthest = std::max(furthest, dot(normal, place - a) / length(normal));
    }
    return furthest;
}

TEST(Dust, OfACellLiesWithinItHasItsMassItsCenterAndItsMomentum) {
    const auto whole = worldOf(withSmallest(shot(), 0)), dusty = worldOf(withSmallest(shot({"dust"}), kAll));
    ASSERT_EQ(firstBreaks(*whole).size(), 1u);
    ASSERT_EQ(firstBreaks(*dusty).size(), 1u);
    std::vector<Cell> cells = cellsOf(*whole);
    for (const gpu::DustParticle& particle : dustOf(*dusty).flying) {
        const auto nearer = [&](const Cell& a, const Cell& b) {
            return outside(a, placeOf(particle)) < outside(b, placeOf(particle));
        };
        Cell& cell = *std::ranges::min_element(cells, nearer);
        EXPECT_LT(outside(cell, placeOf(particle)), 1e-6);
        const double mass = particle.velocity.w;
        cell.dust += mass;
        cell.dust_place = cell.dust_place + mass * placeOf(particle);
        cell.dust_momentum = cell.dust_momentum + mass * vectorOf(particle.velocity);
    }
    ASSERT_GT(cells.size(), 5u);
    for (const Cell& cell : cells) {
        EXPECT_NEAR(cell.dust, cell.mass, 1e-6 * cell.mass);
        EXPECT_LT(length((1 / cell.dust) * cell.dust_place - cell.place), 1e-6);
        EXPECT_LT(length(cell.dust_momentum - cell.momentum), 2e-6 * length(cell.momentum));
    }
}

TEST(Dust, IsFeltByNobody) {
    const brittle::SceneDescription with =
        withSmallest(sceneOf({ball({0, 2, 0}, "concrete"), ball({0.3, 2.4, 0}, "")}, {"dust"}), kSome);
    brittle::SceneDescription without = with;
    std::erase(without.effects, "dust");
    const auto dusty = worldOf(with), plain = worldOf(without);
    for (uint32_t k = 0; k < 90; ++k) {
        step(*dusty);
        step(*plain);
        ASSERT_EQ(*dusty->hash(), *plain->hash()) << k;
    }
    EXPECT_GT(dustOf(*dusty).made.particles, 0u);
    EXPECT_EQ(dustOf(*plain).made.particles, 0u);
}

// ---- how it falls ---------------------------------------------------------------------------------------------------------

// Of a ball of that mass in air, where its drag (Schiller and Naumann) is its weight.
double terminalSpeed(double mass, double radius) {
    double low = 0, high = 1000;
    for (int k = 0; k < 200; ++k) {
        const double v = (low + high) / 2, reynolds = 1.225 * v * 2 * radius / 1.789e-5;
        const double coefficient = std::max(24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687)), 0.44);
        const double drag = 0.5 * 1.225 * v * v * coefficient * M_PI * radius * radius;
        (drag < mass * 9.81 ? low : high) = v;
    }
    return (low + high) / 2;
}

TEST(Dust, FallsAsFastAsTheAirLetsIt) {
    brittle::SceneDescription scene = withSmallest(shot({"dust", "gravity"}), kAll);
    scene.dust.lifetime = 100;
    const auto world = worldOf(scene);
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    step(*world, 2400);
    const auto particles = dustOf(*world).flying;
    ASSERT_FALSE(particles.empty());
    for (const gpu::DustParticle& particle : particles) {
        const double expected = terminalSpeed(particle.velocity.w, particle.place.w);
        EXPECT_NEAR(-particle.velocity.y, expected, 1e-3 * expected);
        EXPECT_LT(std::hypot(particle.velocity.x, particle.velocity.z), 1e-2 * expected);
    }
}

TEST(Dust, LiesOnPlanesUntilItSettles) {
    brittle::SceneDescription scene = withSmallest(sceneOf({ball({0, 3, 0}, "glass")}, {"dust"}), kAll);
    scene.dust.lifetime = 2;
    const auto world = worldOf(scene);
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    step(*world, 90);
    const auto dust = dustOf(*world);
    ASSERT_GT(dust.flying.size(), 100u);
    for (const gpu::DustParticle& particle : dust.flying) {
        EXPECT_EQ(particle.birth.z, 1u);
        EXPECT_NEAR(placeOf(particle)[1], double{particle.place.w}, 1e-5);
    }
    step(*world, 28);
    EXPECT_EQ(dustOf(*world).flying.size(), dust.flying.size());
    step(*world, 3);
    const auto later = dustOf(*world);
    EXPECT_TRUE(later.flying.empty());
    expectAmount(later.settled, later.made);
    expectAmount(later.made, dust.inTheAir());
}

// ---- room -----------------------------------------------------------------------------------------------------------------

TEST(Dust, WhatThereIsNoRoomForIsCountedAndNothingElseGoesWrong) {
    std::vector<brittle::BodyDescription> bodies;
    for (int k = 0; k < 6; ++k)
        bodies.push_back(ball({0.5 * k, 1.5 + 0.35 * k, 0}, "concrete"));
    brittle::SceneDescription scene = withSmallest(sceneOf(bodies, {"dust"}), kSome);
    scene.dust.lifetime = 0.4;
    const auto plenty = worldOf(scene);
    step(*plenty, 90);
    const auto all = dustOf(*plenty);
    ASSERT_GT(all.made.particles, 60u);
    EXPECT_EQ(all.overwritten.particles, 0u);
    for (const uint32_t room : {1u, 8u, 64u}) {
        brittle::WorldBudget budget;
        budget.breaking.particles = room;
        const auto world = worldOf(scene, budget);
        for (uint32_t k = 0; k < 90; ++k) {
            step(*world);
            const auto dust = dustOf(*world);
            const auto flying = dust.inTheAir();
            ASSERT_LE(flying.particles, room);
            ASSERT_EQ(dust.made.particles, flying.particles + dust.settled.particles + dust.overwritten.particles);
            ASSERT_EQ(dust.made.mass, flying.mass + dust.settled.mass + dust.overwritten.mass) << "to the last grain";
        }
        const auto dust = dustOf(*world);
        expectAmount(dust.made, all.made);
        EXPECT_GT(dust.overwritten.particles, 0u);
        EXPECT_EQ(*world->hash(), *plenty->hash());
    }
}

// ---- bit for bit ----------------------------------------------------------------------------------------------------------

bool sameParticles(const brittle::Dust& a, const brittle::Dust& b) {
    const size_t bytes = a.flying.size() * sizeof(gpu::DustParticle);
    return a.flying.size() == b.flying.size() && std::memcmp(a.flying.data(), b.flying.data(), bytes) == 0;
}

TEST(Dust, IsTheSameBitForBitInEveryRunAndWithGroupsOfAnySize) {
    const brittle::SceneDescription scene =
        withSmallest(sceneOf({ball({0, 2, 0}, "concrete"), ball({1, 2, 0}, "glass")}, {"dust"}), kSome);
    std::vector<brittle::Dust> outcomes;
    for (const uint32_t group_size : {64u, 64u, 32u}) {
        brittle::WorldBudget budget;
        budget.group_size = group_size;
        const auto world = worldOf(scene, budget);
        step(*world, 50);
        outcomes.push_back(dustOf(*world));
    }
    ASSERT_GT(outcomes[0].flying.size(), 10u);
    for (const brittle::Dust& outcome : outcomes) {
        EXPECT_TRUE(sameParticles(outcome, outcomes[0]));
        expectAmount(outcome.made, outcomes[0].made);
    }
}

TEST(Dust, GoesOnFromASavedStateInTheMiddleOfItsFlight) {
    brittle::SceneDescription scene =
        withSmallest(sceneOf({ball({0, 2, 0}, "concrete"), ball({1, 3, 0}, "concrete")}, {"dust"}), kSome);
    scene.dust.lifetime = 0.5;
    const auto world = worldOf(scene);
    ASSERT_EQ(firstBreaks(*world).size(), 1u);
    step(*world, 3);
    const auto state = world->save();
    ASSERT_TRUE(state);
    step(*world, 20);
    const auto first = dustOf(*world);
    ASSERT_TRUE(world->restore(*state));
    step(*world, 20);
    const auto again = dustOf(*world);
    EXPECT_TRUE(sameParticles(again, first));
    expectAmount(again.made, first.made);
    expectAmount(again.settled, first.settled);
    EXPECT_GT(first.made.particles, first.inTheAir().particles - 1);
}

// ---- what it costs --------------------------------------------------------------------------------------------------------

bool has(const brittle::StepPlan& plan, const std::string& kernel) {
    return std::ranges::count(plan.kernels, kernel) != 0 ||
           std::ranges::count(plan.passes, kernel, &brittle::Pass::kernel) != 0;
}

TEST(DustGates, WhereItIsOffThereAreNoBytesNoPassesAndNoKernels) {
    const auto on = worldOf(withSmallest(shot({"dust"}), kSome))->plan(), off = worldOf(withSmallest(shot(), kSome))->plan();
    ASSERT_TRUE(on && off);
    EXPECT_GT(on->bytesOf(brittle::Effect::Dust), 16384u * sizeof(gpu::DustParticle));
    EXPECT_EQ(off->bytesOf(brittle::Effect::Dust), 0u);
    for (const char* kernel : {"step_dust", "allot_dust", "emit_dust"}) {
        EXPECT_TRUE(has(*on, kernel)) << kernel;
        EXPECT_FALSE(has(*off, kernel)) << kernel;
    }
    EXPECT_EQ(on->passes.size(), off->passes.size() + 3);
}

// Told and not judged: nothing flies here, and then 1024 particles do.
TEST(DustGates, TheCostIsTold) {
    for (const bool flies : {false, true})
        for (const bool on : {false, true}) {
            brittle::SceneDescription scene = withSmallest(sceneOf({ball({0, flies ? 3.0 : kBall, 0}, "glass")}), kAll);
            if (on) scene.effects.emplace_back("dust");
            const auto world = worldOf(scene);
            step(*world, 60);
            const auto us = world->measure(20);
            const auto plan = world->plan();
            ASSERT_TRUE(us && plan);
            std::printf("dust %-3s %5zu particles: %9llu bytes, %8.1f us\n", on ? "on" : "off", dustOf(*world).flying.size(),
                        static_cast<unsigned long long>(plan->bytes()), std::accumulate(us->begin(), us->end(), 0.0));
        }
}

} // namespace
