// What a blow does: stress, cracks that are paid for by the motion of both bodies, and the contact, against laws integrated by
// other means and against what has to hold.
#include "modules/brittle/effects/blow.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace brittle;

namespace {

BodyForm boxForm(double x, double y, double z) { return formOf(x * y * z, 2 * (x * y + y * z + z * x)); }

// ---- blows ----------------------------------------------------------------------------------------------------------------

// Bars that meet: momentum and the lengths of both have to fit, which gives the stress at once.
TEST(SmallBlow, PressesAsBarsThatMeet) {
    const Material& glass = *findMaterial("glass");
    const BodyForm cube = boxForm(0.1, 0.1, 0.1);
    const double impedance = 2500 * std::sqrt(70e9 / 2500);
    EXPECT_NEAR(impactStress(glass, cube, {1, 2, impedance}), impedance, 1e-6 * impedance);
    EXPECT_NEAR(impactStress(glass, cube, {1, 2}), 2 * impedance, 1e-6 * impedance);
    EXPECT_NEAR(impactStress(glass, cube, {1, 2, impedance / 3}), 2 * impedance / 4, 1e-6 * impedance);
    EXPECT_NEAR(impactStress(glass, boxForm(1, 1, 1e-4), {1, 2}), std::sqrt(3) * 2 * impedance, 1e-6 * impedance);
}

TEST(SmallBlow, BreaksByStressAndByEnergyAndNotByOneAlone) {
    const Material& glass = *findMaterial("glass");
    const BodyForm pane = boxForm(1, 1, 0.004);
    const double strength = strengthOf(glass, pane.volume, 0.5);
    EXPECT_TRUE(breaks(glass, pane, strength, {1, 10}));
    EXPECT_FALSE(breaks(glass, pane, strength, {1e3, 0.5})) << "a soft push";
    EXPECT_FALSE(breaks(glass, pane, strength, {1e-5, 100})) << "a grain of sand";
    EXPECT_FALSE(breaks(glass, pane, strength, {1, 0}));
    Material coarse = glass;
    coarse.smallest_cell = 2;
    EXPECT_FALSE(breaks(coarse, pane, strength, {1, 10})) << "no room for two fragments";
}

TEST(SmallBlow, WhatBreaksABodyAlsoBreaksItHarder) {
    const BodyForm cup = formOf(1e-4, 0.06);
    for (const Material& material : builtinMaterials())
        for (uint32_t k = 0; k < 100; ++k) {
            const double strength = strengthOf(material, cup.volume, chanceOf(1, k));
            bool broken = false;
            for (double speed = 0.01; speed < 300; speed *= 1.1) {
                const bool breaks_now = breaks(material, cup, strength, {0.2, speed, 1e7});
                EXPECT_TRUE(breaks_now || !broken) << material.name;
                broken = breaks_now;
            }
            EXPECT_TRUE(broken) << material.name;
        }
}

TEST(SmallBlow, CracksCostWhatIsPaidForThem) {
    const Material& stone = *findMaterial("stone");
    EXPECT_NEAR(crackEnergyOf(stone, affordedCracks(stone, 300)), stone.eta * 300, 1e-12);
    const BodyForm cube = boxForm(0.2, 0.2, 0.2);
    const uint32_t count = fragmentCount(stone, cube, 5e3, 0);
    EXPECT_LE(crackEnergyOf(stone, crackAreaOf(cube, count)), stone.eta * 5e3);
}

// ---- the ledger -----------------------------------------------------------------------------------------------------------

using Vector = Eigen::Matrix<long double, 3, 1>;
using Tensor = Eigen::Matrix<long double, 3, 3>;

struct Rigid {
    long double mass;
    Tensor inertia;
    Vector velocity, spin, arm;
    long double energy() const { return (mass * velocity.squaredNorm() + spin.dot(inertia * spin)) / 2; }
    Vector speed() const { return velocity + spin.cross(arm); }
    void push(const Vector& impulse) {
        velocity += impulse / mass;
        spin += inertia.inverse() * arm.cross(impulse);
    }
    long double givesWay(const Vector& n) const { return 1 / mass + n.dot((inertia.inverse() * arm.cross(n)).cross(arm)); }
};

Rigid anyBody(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Vector(any(random), any(random), any(random)); };
    Rigid body;
    body.mass = std::pow(10.0L, 3 * any(random));
    const Vector sides = Vector::Ones() + 0.5L * vector();
    const Tensor axes = Eigen::Quaternion<long double>(Eigen::Quaternion<long double>::UnitRandom()).toRotationMatrix();
    const Vector squares = sides.cwiseProduct(sides);
    const Vector moments(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
    body.inertia = axes * (body.mass / 12 * moments).asDiagonal() * axes.transpose();
    body.velocity = 10 * vector();
    body.spin = 5 * vector();
    body.arm = vector();
    return body;
}

TEST(SmallCrackImpulse, TakesExactlyTheEnergyOfTheCracksFromAnyPair) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> share(0, 1);
    for (int k = 0; k < 2000; ++k) {
        Rigid a = anyBody(random), b = anyBody(random);
        Vector n = Vector::Random().normalized();
        if (n.dot(b.speed() - a.speed()) > 0) n = -n;
        const auto speed = static_cast<double>(-n.dot(b.speed() - a.speed()));
        const Blow blow{static_cast<double>(1 / (a.givesWay(n) + b.givesWay(n))), speed};
        const double joules = share(random) * energyOf(blow);
        const long double before = a.energy() + b.energy();
        const Vector momentum = a.mass * a.velocity + b.mass * b.velocity;
        const double impulse = crackImpulse(blow, joules);
        a.push(-impulse * n);
        b.push(impulse * n);
        EXPECT_NEAR(static_cast<double>(before - a.energy() - b.energy() - joules), 0, 1e-12 * static_cast<double>(before));
        EXPECT_LT((a.mass * a.velocity + b.mass * b.velocity - momentum).norm(), 1e-12L * (1 + momentum.norm()));
        EXPECT_GE(static_cast<double>(-n.dot(b.speed() - a.speed())), -1e-9) << "they are not turned back";
    }
}

TEST(SmallCrackImpulse, StopsWhatHasNoMoreAndIsExactForLittle) {
    const Blow blow{2, 3};
    EXPECT_EQ(crackImpulse(blow, 0), 0);
    EXPECT_NEAR(crackImpulse(blow, 9), 6, 1e-12);
    EXPECT_NEAR(crackImpulse(blow, 1e6), 6, 1e-12);
    EXPECT_EQ(crackImpulse({2, 0}, 5), 0);
    EXPECT_NEAR(crackImpulse(blow, 1e-15) / (1e-15 / 3), 1, 1e-12);
    double before = 0;
    for (double joules = 0.1; joules < 9; joules += 0.1) {
        EXPECT_GT(crackImpulse(blow, joules), before);
        before = crackImpulse(blow, joules);
    }
}

// ---- the contact ----------------------------------------------------------------------------------------------------------

// How near two bodies come that push each other with 4/3 E sqrt(R) d^(3/2), stepped through time (Runge and Kutta's fourth).
double nearestApproach(double mass, double speed, double radius, double modulus) {
    const auto pushed = [&](double d) { return d > 0 ? -4.0 / 3 * modulus * std::sqrt(radius) * std::pow(d, 1.5) / mass : 0; };
    const double guess = std::pow(mass * speed * speed / (modulus * std::sqrt(radius)), 0.4);
    const double dt = guess / speed / 2000;
    double d = 0, v = speed, most = 0;
    while (v > 0) {
        const double v2 = v + dt / 2 * pushed(d), a2 = pushed(d + dt / 2 * v);
        const double v3 = v + dt / 2 * a2, a3 = pushed(d + dt / 2 * v2), v4 = v + dt * a3, a4 = pushed(d + dt * v3);
        const double a1 = pushed(d);
        d += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        most = std::max(most, d);
    }
    return most;
}

TEST(SmallContactRadius, IsThatOfSpheresThatAreStopped) {
    for (const auto& [mass, speed, radius] :
         std::vector<std::array<double, 3>>{{0.03, 5, 0.01}, {10, 1, 0.5}, {1e-3, 50, 1e-3}}) {
        const double modulus = sharedModulusOf(70e9 / 0.96, 33e9 / 0.96);
        EXPECT_NEAR(modulus, 1 / (0.96 / 70e9 + 0.96 / 33e9), 1);
        const double expected = std::sqrt(radius * nearestApproach(mass, speed, radius, modulus));
        EXPECT_NEAR(hertzRadiusOf({mass, speed}, radius, modulus) / expected, 1, 1e-5);
    }
    EXPECT_EQ(hertzRadiusOf({1, 0}, 1, 1e9), 0);
    EXPECT_EQ(sharedModulusOf(5e9, RIGID_MODULUS), 5e9);
}

TEST(SmallContactRadius, GrowsWithSpeedMassAndSoftness) {
    const double usual = hertzRadiusOf({1, 1}, 0.1, 1e10);
    EXPECT_GT(hertzRadiusOf({1, 2}, 0.1, 1e10), usual);
    EXPECT_GT(hertzRadiusOf({2, 1}, 0.1, 1e10), usual);
    EXPECT_GT(hertzRadiusOf({1, 1}, 0.1, 1e9), usual);
    EXPECT_GT(hertzRadiusOf({1, 1}, 0.2, 1e10), usual);
}

} // namespace
