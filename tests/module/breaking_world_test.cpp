// Worlds in which bodies break: where they are hit, as hard as they are hit, without the host.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/effects/material.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"
#include "tests/support/solids.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::ColliderDescription, brittle::SceneDescription;
using brittle::Double3, brittle::operator+, brittle::operator-, brittle::operator*;

TEST(BreakingWorld, ABallOfGlassThatFallsFromHighUpBreaks) {
    const auto world = worldOf(sceneOf({ball({0, 3, 0}, "glass")}));
    const double mass = massOf(presentBodies(*world));
    const auto events = stepUntilItBreaks(*world, 60);
    ASSERT_EQ(events.size(), 1u);
    const auto fragments = presentBodies(*world);
    EXPECT_EQ(fragments.size(), events[0].made.x);
    EXPECT_GT(fragments.size(), 100u);
    const double told = events[0].offset.w; // of what is too small for a body
    EXPECT_NEAR(massOf(fragments) + told, mass, 1e-6 * mass);
    step(*world, 60);
    for (const gpu::BodyState& body : presentBodies(*world)) {
        const Double3 place = brittle::poseOf(body).place;
        EXPECT_GT(place[1], -0.01);
        EXPECT_LT(std::hypot(place[0], place[2]), 30);
    }
    EXPECT_NEAR(massOf(presentBodies(*world)) + told, mass, 1e-6 * mass);
}

// Signed volumes of the tetrahedra between its triangles and its center of mass.
double volumeOf(const brittle::SurfaceMesh& surface) {
    double volume = 0;
    for (size_t t = 0; t + 2 < surface.indices.size(); t += 3) {
        const auto corner = [&](size_t k) { return brittle::positionOf(surface.vertices[surface.indices[t + k]]); };
        volume += brittle::dot(corner(0), brittle::cross(corner(1), corner(2))) / 6;
    }
    return volume;
}

double outerAreaOf(const brittle::SurfaceMesh& surface) {
    double area = 0;
    for (size_t t = 0; t + 2 < surface.outer_index_count; t += 3) {
        const auto corner = [&](size_t k) { return brittle::positionOf(surface.vertices[surface.indices[t + k]]); };
        area += brittle::length(
                    brittle::cross(brittle::operator-(corner(1), corner(0)), brittle::operator-(corner(2), corner(0)))) /
                2;
    }
    return area;
}

TEST(BreakingWorld, FragmentsTellWhatTheyLookLike) {
    brittle::BodyDescription thrown = ball({0, 0.2, 0}, "glass");
    thrown.velocity = {0, -9, 0};
    brittle::WorldSurfaces surfaces;
    SceneDescription scene = sceneOf({ball({5, kBall, 0}, "glass"), thrown});
    scene.breaking.smallest_piece = 0; // every cell is a fragment
    ASSERT_TRUE(brittle::contentsOf(scene, {}, nullptr, &surfaces));
    const auto world = worldOf(scene);
    EXPECT_TRUE(world->fragments()->empty());
    uint32_t steps = 0;
    for (; steps < 10 && world->fragments()->empty(); ++steps)
        ASSERT_TRUE(world->step());
    const auto fragments = world->fragments();
    const auto looks = world->surfacesOf(*fragments);
    const auto states = world->bodies();
    const auto counts = world->counts();
    ASSERT_TRUE(looks && states && counts);
    EXPECT_EQ(counts->broken, 1u);
    EXPECT_EQ(counts->fragments, fragments->size());
    EXPECT_EQ(fragments->size() + 1, presentBodies(*world).size());
    double volume = 0, area = 0;
    for (size_t k = 0; k < fragments->size(); ++k) {
        const brittle::BodyFragment& fragment = (*fragments)[k];
        EXPECT_EQ(fragment.step, steps);
        EXPECT_EQ(fragment.origin, 1u);
        EXPECT_NEAR(volumeOf((*looks)[k]) * 2500 * (*states)[fragment.slot].offset.w, 1, 0.02) << k; // kg of glass
        volume += volumeOf((*looks)[k]);
        area += outerAreaOf((*looks)[k]);
    }
    const brittle::SurfaceMesh& whole = surfaces.meshes[surfaces.bodies[1].mesh];
    EXPECT_NEAR(volume, volumeOf(whole), 1e-5 * volume);
    EXPECT_NEAR(area, outerAreaOf(whole), 1e-4 * area);
}

// Returns whether more than two triangles have the same two corners.
bool touchesItself(const brittle::SurfaceMesh& surface) {
    std::map<std::set<brittle::Float3>, uint32_t> uses;
    const auto placeOf = [&](size_t k) {
        const float* p = surface.vertices[surface.indices[k]].position;
        return brittle::Float3{p[0], p[1], p[2]};
    };
    for (size_t k = 0; k < surface.indices.size(); ++k)
        ++uses[{placeOf(k), placeOf(k - k % 3 + (k + 1) % 3)}];
    return std::ranges::any_of(uses, [](const auto& use) { return use.second > 2; });
}

TEST(BreakingWorld, PartsThatTouchAlongAnEdgeComeApartWhenTheirBodyBreaks) {
    using support::operator+;
    BodyDescription pair = ball({0, 0.2, 0}, "glass");
    pair.velocity = {0, -9, 0};
    pair.shape.kind = brittle::ShapeKind::Mesh;
    pair.shape.model = std::make_shared<brittle::ImportedMesh>(support::moved(brittle::makeCube(), 0.1, {0, 0, 0}) +
                                                               support::moved(brittle::makeCube(), 0.1, {0.1, 0.1, 0}));
    pair.shape.cells.sites = 1;
    const SceneDescription scene = sceneOf({pair});
    brittle::WorldSurfaces surfaces;
    const auto fracture = brittle::fractureFor(scene, engine_test::device());
    ASSERT_TRUE(fracture && brittle::contentsOf(scene, {}, fracture->get(), &surfaces));
    EXPECT_TRUE(touchesItself(surfaces.meshes[surfaces.bodies[0].mesh]));
    const auto world = worldOf(scene);
    ASSERT_EQ(stepUntilItBreaks(*world, 10).size(), 1u);
    const auto looks = world->surfacesOf(*world->fragments());
    ASSERT_TRUE(looks);
    EXPECT_GT(looks->size(), 10u);
    for (const brittle::SurfaceMesh& look : *looks)
        EXPECT_FALSE(touchesItself(look));
}

TEST(BreakingWorld, ABallThatIsSetDownDoesNotBreak) {
    const auto world = worldOf(sceneOf({ball({0, kBall + 0.001, 0}, "glass")}));
    step(*world, 30);
    EXPECT_EQ(presentBodies(*world).size(), 1u);
}

TEST(BreakingWorld, WhatBreaksKeepsMassAndMomentumAndPaysForItsCracks) {
    for (const char* material : {"concrete", "stone"}) {
        const auto world = worldOf(shot(8, material));
        const Motion before = motionOf(presentBodies(*world));
        const auto events = stepUntilItBreaks(*world, 30);
        ASSERT_EQ(events.size(), 1u) << material;
        const Motion after = motionOf(presentBodies(*world));
        EXPECT_NEAR(after.mass, before.mass, 1e-6 * before.mass);
        EXPECT_LT(sizeOf(after.momentum - before.momentum), 1e-5 * sizeOf(before.momentum));
        EXPECT_LT(sizeOf(after.angular - before.angular), 1e-5 * sizeOf(before.angular));
        const gpu::vec4& paid = events[0].energies;
        EXPECT_NEAR(before.energy - after.energy, double{paid.z}, 1e-5 * before.energy) << "all that is lost went into cracks";
        EXPECT_NEAR(paid.x - paid.y, paid.z, 1e-5 * before.energy);
        const brittle::Material* card = brittle::findMaterial(material);
        EXPECT_NEAR(paid.z, card->fracture_energy * double{paid.w}, 1e-4 * double{paid.z});
        EXPECT_GT(events[0].made.x, 2u);
    }
}

TEST(BreakingWorld, FragmentsMoveAsTheirBodyDidWhereTheyAre) {
    SceneDescription scene = shot(8, "concrete");
    scene.bodies[0].spin = {3, -2, 5};
    const auto world = worldOf(scene);
    ASSERT_EQ(stepUntilItBreaks(*world, 30).size(), 1u);
    auto fragments = presentBodies(*world);
    std::erase_if(fragments, [](const gpu::BodyState& body) { return std::fabs(1 / body.offset.w - 4) < 1e-4; });
    const Motion sum = motionOf(fragments);
    const Double3 velocity = (1 / sum.mass) * sum.momentum, spin = vectorOf(fragments[0].spin);
    Double3 center = {0, 0, 0};
    for (const gpu::BodyState& body : fragments)
        center = center + (1 / (double{body.offset.w} * sum.mass)) * brittle::poseOf(body).place;
    for (const gpu::BodyState& body : fragments) {
        const Double3 there = velocity + brittle::cross(spin, brittle::poseOf(body).place - center);
        EXPECT_LT(sizeOf(vectorOf(body.velocity) - there), 1e-4);
        EXPECT_LT(sizeOf(vectorOf(body.spin) - spin), 1e-4);
    }
}

TEST(BreakingWorld, StepsDoNotDecideHowHardAFlyingBodyIsHit) { expectAlikeInStepsOfAnyLength(shot(8, "concrete"), 0.01, 0); }

TEST(BreakingWorld, StepsHardlyDecideHowHardAFallIs) {
    expectAlikeInStepsOfAnyLength(sceneOf({ball({0, 2, 0}, "concrete")}), 0.05, 0.15);
}

TEST(BreakingWorld, IsTheSameBitForBitInEveryRunAndWithGroupsOfAnySize) {
    std::vector<uint64_t> hashes;
    for (const uint32_t group_size : {64u, 64u, 32u}) {
        brittle::WorldBudget budget;
        budget.group_size = group_size;
        const auto world = worldOf(shot(8, "concrete"), budget);
        ASSERT_EQ(stepUntilItBreaks(*world, 30).size(), 1u);
        step(*world, 20);
        const auto hash = world->hash();
        ASSERT_TRUE(hash);
        hashes.push_back(*hash);
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(BreakingWorld, GoesOnFromASavedStateAsIfNothingHadHappened) {
    const auto world = worldOf(shot(8, "concrete"));
    step(*world, 2);
    const auto state = world->save();
    ASSERT_TRUE(state);
    step(*world, 30);
    const auto hash = world->hash();
    ASSERT_TRUE(world->restore(*state));
    step(*world, 30);
    EXPECT_EQ(*world->hash(), *hash);
    EXPECT_GT(presentBodies(*world).size(), 3u);
}

TEST(BreakingWorld, TenBodiesBreakInOneStep) {
    std::vector<BodyDescription> bodies;
    for (int k = 0; k < 10; ++k)
        bodies.push_back(ball({0.5 * k, 1.5, 0}, "concrete"));
    const auto world = worldOf(sceneOf(std::move(bodies)));
    const double mass = massOf(presentBodies(*world));
    EXPECT_EQ(stepUntilItBreaks(*world, 60).size(), 10u);
    EXPECT_NEAR(massOf(presentBodies(*world)), mass, 1e-6 * mass);
}

TEST(BreakingWorld, FragmentsBreakAgainWhereThatIsAskedFor) {
    for (const bool again : {false, true}) {
        SceneDescription scene = sceneOf({ball({0, 2, 0}, "concrete"), ball({0, 6, 0}, "")});
        if (again) scene.effects.push_back("refracture");
        scene.bodies[1].mass = 60;
        scene.bodies[1].velocity = {0, -8, 0};
        const auto world = worldOf(scene);
        const double mass = massOf(presentBodies(*world));
        uint32_t of_fragments = 0;
        for (uint32_t k = 0; k < 60; ++k) {
            step(*world);
            const auto breaks = world->breaks();
            ASSERT_TRUE(breaks);
            for (const gpu::BreakEvent& event : breaks->events)
                of_fragments += event.what.y >= 3 && event.made.x > 0 ? 1 : 0;
        }
        EXPECT_EQ(of_fragments > 0, again);
        EXPECT_NEAR(massOf(presentBodies(*world)), mass, 1e-5 * mass);
    }
}

// A heap of ice that breaks again and again, in which bodies are hit from several sides at once.
SceneDescription hail() {
    SceneDescription scene = sceneOf({});
    scene.effects.push_back("refracture");
    scene.budgets.most_fragments = 6;
    for (int k = 0; k < 8; ++k) {
        BodyDescription body;
        body.shape.size = {0.15, 0.15, 0.15};
        body.material = "ice";
        body.place = {0.05 * (k % 2), 0.5 + 0.3 * k, 0};
        body.turn = {0.5, 0.1, 0.5, 0.7 + 0.3 * k};
        body.velocity = {0, -4, 0};
        scene.bodies.push_back(body);
    }
    return scene;
}

// What other contacts have taken in the same step is no more there to pay with.
TEST(BreakingWorld, EveryCrackIsPaidForByThePairHoweverManyOthersHitIt) {
    const SceneDescription scene = hail();
    const auto world = worldOf(scene, brittle::budgetOf(scene, 0));
    uint32_t paid = 0, too_dear = 0;
    for (uint32_t k = 0; k < 90; ++k) {
        step(*world);
        const auto told = world->breaks();
        ASSERT_TRUE(told);
        for (const gpu::BreakEvent& event : told->events) {
            const gpu::vec4& e = event.energies;
            too_dear += event.made.y == WHOLE_TOO_DEAR ? 1 : 0;
            if (event.made.y != 0 || event.made.z != 0) continue;
            ++paid;
            EXPECT_GE(double{e.x} - double{e.y}, 0.999 * double{e.z} - 1e-6 * double{e.x}) << "in step " << event.what.x;
            EXPECT_GT(e.w, 0);
        }
    }
    EXPECT_GT(paid, 60u);
    EXPECT_GT(too_dear, 0u) << "in none had others taken so much";
}

// A step is long enough for the ball to reach the wall, but it is stopped before: by the pane.
TEST(BreakingWorld, WhatStandsBehindAPaneTakesNothingOfTheBlowThatBreaksIt) {
    SceneDescription scene = sceneOf({ball({0.05, 0.03, 0.4}, "")}, false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    scene.bodies[0].mass = 1;
    scene.bodies[0].velocity = {0, 0, -10};
    BodyDescription pane;
    pane.shape.size = {0.6, 0.6, 0.008};
    pane.material = "glass";
    scene.bodies.push_back(pane);
    for (const double gap : {0.001, 0.1})
        for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
            scene.step.dt = dt;
            ColliderDescription wall;
            wall.shape = {.kind = brittle::ShapeKind::Box, .size = {1, 1, 0.1}};
            wall.place = {0, 0, -0.054 - gap};
            scene.colliders = {wall};
            const auto world = worldOf(scene);
            const auto events = stepUntilItBreaks(*world, 20);
            ASSERT_EQ(events.size(), 1u) << gap << " " << dt;
            EXPECT_EQ(events[0].made.y, 0u) << "why it stays whole, at " << gap << " " << dt;
            EXPECT_NEAR(events[0].energies.x, 50, 0.01);
        }
}

// A blow that would break something is put off to the next step, and may have been all that the striker touched.
TEST(BreakingWorld, WhatIsAboutToBreakABodyAtRestFliesOnUntilThen) {
    BodyDescription block = ball({0, 0.0999, 0}, "glass"), striker = ball({0, 0.8, 0}, "");
    striker.velocity = {0, -10, 0};
    const auto world = worldOf(sceneOf({striker, block}));
    const auto height = [&] { return brittle::poseOf(presentBodies(*world)[0]).place[1]; };
    double before = height(), way = 0;
    for (uint32_t k = 0; k < 30 && stepUntilItBreaks(*world, 1).empty(); ++k) {
        way = before - height();
        before -= way;
        EXPECT_GT(way, 10.0 / 60) << "step " << k;
    }
    EXPECT_LT(before, 0.2999) << "it is to break in a later step than it is struck";
}

// They would meet each other where the cube is.
TEST(BreakingWorld, WhatIsHitFromSixSidesAtOnceBreaks) {
    SceneDescription scene = sceneOf({}, false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    BodyDescription cube;
    cube.shape.size = {0.3, 0.3, 0.3};
    cube.material = "concrete";
    scene.bodies = {cube};
    for (size_t k = 0; k < 6; ++k) {
        BodyDescription shot = ball({0, 0, 0}, "");
        shot.shape.radius = 0.04;
        shot.mass = 3;
        const double side = k % 2 == 0 ? 1 : -1;
        shot.place[k / 2] = 0.4 * side;
        shot.velocity[k / 2] = -20 * side;
        scene.bodies.push_back(shot);
    }
    const auto world = worldOf(scene);
    const auto events = stepUntilItBreaks(*world, 10);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].made.y, 0u);
    EXPECT_GT(events[0].made.x, 30u);
    EXPECT_NEAR(events[0].energies.x, 600, 1) << "no other ball has taken any of it";
}

} // namespace
