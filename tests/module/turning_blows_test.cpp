// What turns is hit as it stands when it meets something, and where it meets it.
#include "modules/brittle/effects/material.h"
#include "tests/module/breaking_scenes.h"
#include "tests/module/turning_boxes.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace breaking_scenes;
using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription;
using support::SceneRun;
using turning_boxes::TurningBox;

// It turns by up to 19 degrees in a step, and by the time that they meet another of its corners may be the lowest.
SceneDescription turningBar(const Double3& spin) {
    BodyDescription bar;
    bar.shape.size = {0.6, 0.06, 0.06};
    bar.material = "stone";
    bar.spin = spin;
    return sceneOf({bar});
}

TEST(TurningBlows, StepsDoNotDecideHowHardATurningBodyIsHit) {
    for (const double spin : {-10.0, -2.0, 5.0}) {
        SceneDescription scene = turningBar({0, spin, 0});
        scene.effects = {"contacts", "impact_fracture", "events"};
        scene.colliders.clear();
        BodyDescription shot = ball({0.2, 0.01, 1.05}, "");
        shot.shape.radius = 0.05;
        shot.mass = 2;
        shot.velocity = {0, 0, -20};
        scene.bodies.push_back(shot);
        expectAlikeInStepsOfAnyLength(scene, 0.01, 0.05);
    }
}

// How a bar that turns about z as it comes down to y = 0 meets it: with its lowest edge, whose height above the center of mass
// and place beside it follow from the angle; when is found by halving.
TEST(TurningBlows, ATurningBarMeetsTheGroundAsItsLowestEdgeDoes) {
    constexpr double kLong = 0.6, kThick = 0.06, kHeight = 0.5, kSpeed = 5, kSpin = 7;
    SceneDescription scene = turningBar({0, 0, kSpin});
    scene.effects = {"contacts", "impact_fracture", "events"};
    scene.bodies[0].place = {0, kHeight, 0};
    scene.bodies[0].velocity = {0, -kSpeed, 0};
    const auto lowestAt = [&](double time) -> std::array<double, 2> { // beside and above the center of mass
        const double c = std::cos(kSpin * time), s = std::sin(kSpin * time);
        std::array<double, 2> lowest = {0, 1};
        for (const double x : {-kLong / 2, kLong / 2})
            for (const double y : {-kThick / 2, kThick / 2})
                if (s * x + c * y < lowest[1]) lowest = {c * x - s * y, s * x + c * y};
        return lowest;
    };
    double early = 0, late = kHeight / kSpeed;
    for (int k = 0; k < 60; ++k) {
        const double time = (early + late) / 2;
        (kHeight - kSpeed * time + lowestAt(time)[1] > 0 ? early : late) = time;
    }
    const double mass = brittle::findMaterial("stone")->density * kLong * kThick * kThick;
    const double inertia = mass * (kLong * kLong + kThick * kThick) / 12, beside = lowestAt(late)[0];
    const double effective = 1 / (1 / mass + beside * beside / inertia), speed = kSpeed - kSpin * beside;
    ASSERT_GT(speed, 1);
    for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        scene.step.dt = dt;
        const auto world = worldOf(scene);
        const auto events = stepUntilItBreaks(*world, 60);
        ASSERT_EQ(events.size(), 1u);
        EXPECT_NEAR(events[0].blow.x, effective, 1e-3 * effective);
        EXPECT_NEAR(events[0].blow.y, speed, 1e-3 * speed);
        EXPECT_NEAR(events[0].what.x, std::ceil(late / dt), 1);
    }
}

TEST(TurningBlows, StepsHardlyDecideHowHardATumblingFallIs) {
    for (const double spin : {-3.0, 8.0}) {
        SceneDescription scene = turningBar({0, 0.3 * spin, spin});
        scene.bodies[0].place = {0, 1, 0};
        expectAlikeInStepsOfAnyLength(scene, 0.01, 0.05);
    }
}

// Its lower edge is hit, with what that has of its mass, but for what all but lies flat: that is hit in its middle.
TEST(TurningBlows, ARodThatComesDownAskewIsHitAtItsLowerEnd) {
    constexpr double kLong = 1, kThick = 0.06, kSpeed = 6;
    const double mass = brittle::findMaterial("concrete")->density * kLong * kThick * kThick;
    for (const double degrees : {0.0, 0.2, 1.0, 4.0}) {
        BodyDescription rod;
        rod.shape.size = {kLong, kThick, kThick};
        rod.material = "concrete";
        rod.place = {0, 0.6, 0};
        rod.velocity = {0, -kSpeed, 0};
        const double tilt = degrees * M_PI / 180;
        rod.turn = {0, 0, std::sin(tilt / 2), std::cos(tilt / 2)};
        SceneDescription scene = sceneOf({rod});
        scene.effects = {"contacts", "impact_fracture", "events"};
        const double beside = degrees == 0 ? 0 : kLong / 2 * std::cos(tilt) - kThick / 2 * std::sin(tilt);
        const double effective = mass / (1 + 12 * beside * beside / (kLong * kLong + kThick * kThick));
        for (const double dt : {1.0 / 30, 1.0 / 120}) {
            scene.step.dt = dt;
            const auto world = worldOf(scene);
            const auto events = stepUntilItBreaks(*world, 60);
            ASSERT_EQ(events.size(), 1u);
            EXPECT_NEAR(events[0].blow.x, effective, 1e-3 * effective) << degrees << " degrees";
            EXPECT_NEAR(events[0].offset.x, -beside, 1e-3) << degrees << " degrees";
        }
    }
}

struct Throw {
    TurningBox a, b;
};

double between(std::mt19937& random, double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<>()(random);
}

Eigen::Quaterniond randomTurn(std::mt19937& random) {
    const auto part = [&] { return between(random, -1, 1); };
    return Eigen::Quaterniond(part(), part(), part(), part()).normalized();
}

// A world in which they fly straight, for as long as they take: the first break has the energy of the meeting.
void expectHitAsTheyMeet(SceneDescription scene, const turning_boxes::Meeting& meeting, uint32_t which) {
    scene.effects = {"contacts", "impact_fracture", "events"};
    for (const double dt : {1.0 / 30, 1.0 / 60}) {
        scene.step.dt = dt;
        const auto world = worldOf(scene);
        const auto events = stepUntilItBreaks(*world, static_cast<uint32_t>(meeting.time / dt) + 2);
        ASSERT_FALSE(events.empty()) << which << ", 1/" << 1 / dt;
        const double energy = 0.5 * double{events[0].blow.x} * events[0].blow.y * events[0].blow.y;
        EXPECT_NEAR(energy, meeting.energy(), 0.01 * meeting.energy()) << which << ", 1/" << 1 / dt;
    }
}

// They come from either side, each turning about its own axis by up to half a turn in thirty milliseconds.
Throw randomThrow(std::mt19937& random) {
    const auto spunAxis = [&] { return static_cast<uint32_t>(random() % 3); };
    Throw t;
    t.a = {{1, 0.06, 0.06},    {-1.1, 0, 0}, {between(random, 9, 14), 0, 0},
           randomTurn(random), spunAxis(),   between(random, -30, 30)};
    t.b = {{0.8, 0.1, 0.3},
           {1.1, between(random, -0.1, 0.1), between(random, -0.1, 0.1)},
           {between(random, -8, -4), 0, 0},
           randomTurn(random),
           spunAxis(),
           between(random, -30, 30)};
    return t;
}

TEST(TurningBlows, OfTwoThatBothTurnAreThoseOfTheirFirstMeeting) {
    std::mt19937 random(7);
    const double density = brittle::findMaterial("ice")->density;
    uint32_t met = 0;
    for (uint32_t k = 0; k < 16; ++k) {
        const Throw t = randomThrow(random);
        const auto meeting = turning_boxes::firstMeeting(t.a, t.b, density);
        if (!meeting || meeting->energy() < 40) continue; // hard enough to break ice for certain
        ++met;
        expectHitAsTheyMeet(sceneOf({t.a.described("ice"), t.b.described("ice")}, false), *meeting, k);
    }
    EXPECT_GE(met, 8u);
}

// A plate on its edge, which turns as it comes down: the corner that is hit first is often not the one that comes fastest.
TurningBox randomPlate(std::mt19937& random) {
    TurningBox plate = {{0.5, 0.016, 0.5}, {0, 0.8, 0}, {0, -between(random, 4, 7), 0}};
    plate.turn = randomTurn(random);
    plate.axis = static_cast<uint32_t>(random() % 3);
    plate.spin = (random() % 2 == 0 ? 1 : -1) * between(random, 8, 15);
    return plate;
}

TEST(TurningBlows, APlateIsHitAtTheCornerThatMeetsTheGroundFirst) {
    const TurningBox ground = {{1e3, 1e3, 1e3}, {0, -500, 0}};
    const double density = brittle::findMaterial("porcelain")->density;
    std::mt19937 random(3);
    uint32_t met = 0;
    for (uint32_t k = 0; k < 18; ++k) {
        const TurningBox plate = randomPlate(random);
        const auto meeting = turning_boxes::firstMeeting(plate, ground, density);
        ASSERT_TRUE(meeting);
        if (meeting->energy() < 5) continue; // hard enough to break it for certain
        ++met;
        expectHitAsTheyMeet(sceneOf({plate.described("porcelain")}), *meeting, k);
    }
    EXPECT_GE(met, 9u);
}

// m, of a body on its own.
double lowestCorner(const SceneRun& run, const Eigen::Vector3d& size) {
    const gpu::vec4 q = run.state(0).turn;
    return run.place(0)[1] -
           0.5 * (Eigen::Quaterniond(q.w, q.x, q.y, q.z).inverse() * Eigen::Vector3d::UnitY()).cwiseAbs().dot(size);
}

// The corner that is hit first comes with too little to break it. Another one is on its way, fast enough, but not within the
// step.
TEST(TurningBlows, WhatDoesNotBreakAtItsFirstCornerIsStoppedThere) {
    TurningBox plate = {{0.5, 0.02, 0.5}, {0, 0.42, 0}, {0, -1.054113, 0}};
    plate.turn = Eigen::Quaterniond(0.506208, 0.582795, -0.542375, 0.331561).normalized();
    plate.axis = 2;
    plate.spin = -12.660696;
    constexpr double kCornerSpeed = 1.2; // m/s, about
    SceneDescription scene = sceneOf({plate.described("glass")});
    for (const double dt : {1.0 / 30, 1.0 / 60}) {
        scene.step.dt = dt;
        SceneRun run(scene);
        for (double time = 0; time < 0.25; time += dt) {
            run.step(1);
            EXPECT_GT(lowestCorner(run, plate.size), -0.2 * kCornerSpeed * dt) << time << " s, 1/" << 1 / dt;
        }
        EXPECT_EQ(run.world().counts()->broken, 0u) << "1/" << 1 / dt;
    }
}

} // namespace
