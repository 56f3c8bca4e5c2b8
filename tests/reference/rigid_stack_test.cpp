// The oracle of stacks, against what is known without it: weights, the way that friction takes to stop a body.
#include "tests/reference/rigid_stack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using reference::length;
using reference::Point;
using reference::RigidStack;
using reference::StackedBox;
using reference::operator-;

constexpr double kGravity = 10, kFriction = 0.5;

StackedBox boxOf(const Point& half, const Point& place, double mass) {
    const auto face = [&](double y) -> StackedBox::Face {
        return {Point{-half[0], y, -half[2]}, {half[0], y, -half[2]}, {half[0], y, half[2]}, {-half[0], y, half[2]}};
    };
    const auto moment = [&](size_t i, size_t j) { return mass / 3 * (half[i] * half[i] + half[j] * half[j]); };
    return {face(-half[1]), face(half[1]), place, mass, {moment(1, 2), moment(0, 2), moment(0, 1)}, kFriction};
}

std::vector<StackedBox> tower(size_t boxes, const Point& half, double mass) {
    std::vector<StackedBox> all = {boxOf({50, 1, 50}, {0, -1, 0}, 0)};
    for (size_t k = 0; k < boxes; ++k)
        all.push_back(boxOf(half, {0, half[1] * (1 + 2 * static_cast<double>(k)), 0}, mass));
    return all;
}

reference::StackSettings usual() { return {{0, -kGravity, 0}, 1.0 / 60, 4, 30, 10, 3, 0.02}; }

void stepFor(RigidStack& stack, int steps) {
    for (int k = 0; k < steps; ++k)
        stack.step();
}

double pressedWith(const reference::SoftContact& contact) {
    double sum = 0;
    for (const auto& point : contact.points)
        sum += point.impulse;
    return sum;
}

TEST(RigidStack, EachContactCarriesTheWeightAboveIt) {
    constexpr size_t kBoxes = 5;
    RigidStack stack(tower(kBoxes, {0.4, 0.3, 0.5}, 7), usual());
    stepFor(stack, 1200);
    const double weight = 7 * kGravity / 60 / 4; // an impulse a substep
    ASSERT_EQ(stack.contacts().size(), kBoxes);
    for (size_t k = 0; k < kBoxes; ++k)
        EXPECT_NEAR(pressedWith(stack.contacts()[k]) / weight, static_cast<double>(kBoxes - k), 1e-3) << k;
    EXPECT_TRUE(stack.hardlyMoved());
}

TEST(RigidStack, ContactsOfOneColorShareNoBodyThatMoves) {
    const RigidStack stack(tower(20, {0.5, 0.5, 0.5}, 1), usual());
    for (const auto& c : stack.contacts())
        for (const auto& d : stack.contacts()) {
            const bool meet = (c.a != 0 && (c.a == d.a || c.a == d.b)) || (c.b != 0 && (c.b == d.a || c.b == d.b));
            EXPECT_TRUE(&c == &d || c.color != d.color || !meet) << c.a << ' ' << d.a;
        }
}

// In v^2 / (2 mu g), without turning aside.
TEST(RigidStack, FrictionStopsWhatSlides) {
    const double speed = 2;
    std::vector<StackedBox> boxes = tower(1, {0.5, 0.1, 0.5}, 3);
    boxes[1].velocity = {0.6 * speed, 0, 0.8 * speed};
    RigidStack stack(boxes, usual());
    stepFor(stack, 60);
    const Point way = stack.bodies()[1].place - boxes[1].place;
    const double expected = speed * speed / (2 * kFriction * kGravity);
    EXPECT_NEAR(std::hypot(way[0], way[2]) / expected, 1, 0.02);
    EXPECT_NEAR(way[2] / way[0], 8.0 / 6, 1e-3);
    EXPECT_LT(length(stack.bodies()[1].velocity), 1e-3);
}

TEST(RigidStack, WhatLiesOnNothingFallsAsGalileoHasIt) {
    std::vector<StackedBox> boxes = tower(1, {0.5, 0.5, 0.5}, 1);
    boxes[1].place[1] += 10;
    RigidStack stack(boxes, usual());
    ASSERT_TRUE(stack.contacts().empty());
    stepFor(stack, 60);
    // Speeds lag places by half a substep.
    EXPECT_NEAR(boxes[1].place[1] - stack.bodies()[1].place[1], 0.5 * kGravity, 1e-9);
    EXPECT_NEAR(stack.bodies()[1].velocity[1], -kGravity * (1 - 0.5 / 240), 1e-9);
}

} // namespace
