// Stacks for a minute, at every scale, and heavy cubes on light ones; nothing sleeps.
#include "modules/brittle/scene/library/long_stacks.h"

#include "modules/brittle/scene/library/scene_parts.h"

#include <algorithm>
#include <array>

namespace brittle::library {
namespace {

struct Tall {
    uint32_t cubes;
    double edge;    // m
    double gravity; // m/s2
    uint32_t seconds;
};
constexpr std::array<Tall, kTallStacks> kTall = {{{8, 1, 9.81, 60},
                                                  {10, 0.1, 9.81, 60},
                                                  {10, 0.05, 9.81, 60},
                                                  {5, 0.005, 9.81, 10},
                                                  {5, 0.002, 9.81, 10},
                                                  {6, 0.05, 98.1, 10},
                                                  {40, 1, 9.81, 60},
                                                  {40, 0.002, 9.81, 10},
                                                  {20, 10, 98.1, 60},
                                                  {4, 0.05, 98.1, 60},
                                                  {5, 0.002, 98.1, 10},
                                                  {40, 0.002, 98.1, 10}}};

// Corners of an upright prism with `sides` sides.
std::vector<Double3> cylinder(double radius, double height, uint32_t sides) {
    std::vector<Double3> points;
    for (uint32_t k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        for (const double y : {-height / 2, height / 2})
            points.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
    }
    return points;
}

// `gap`: between the cubes, in edges.
SceneDescription heavyAndLight(double edge, double gap, uint32_t ratio, const std::string& how) {
    SceneDescription scene = newScene(
        "A cube of " + std::to_string(ratio) + " kg " + how +
            " one of 1 kg.\nPasses: after 10 s the heavy one is within 1 % of an edge of its place, upright and at rest.",
        4 * edge);
    scene.gravity = {0, -9.81, 0};
    scene.step.steps = 600;
    addGround(scene);
    addBox(scene, {edge, edge, edge}, {0, 0.5 * edge, 0}).mass = 1;
    addBox(scene, {edge, edge, edge}, {0, (1.5 + gap) * edge, 0}).mass = ratio;
    return scene;
}

} // namespace

SceneDescription tallStack(uint32_t number) {
    const Tall& tall = kTall.at(std::min(number, kTallStacks - 1));
    SceneDescription scene =
        newScene("A stack of " + std::to_string(tall.cubes) + " cubes stands for " + std::to_string(tall.seconds) +
                     " s without sleeping.\n"
                     "Passes: the top moves by at most 1 % of an edge aside and 2 % in height; in the end "
                     "nothing moves faster than 5 mm/s or a thousandth of an edge a second.",
                 std::max(4.0, 0.9 * tall.cubes) * tall.edge);
    scene.gravity = {0, -tall.gravity, 0};
    scene.step.steps = 60 * tall.seconds;
    addGround(scene);
    for (uint32_t k = 0; k < tall.cubes; ++k)
        addBox(scene, {tall.edge, tall.edge, tall.edge}, {0, tall.edge * (0.5 + k), 0});
    return scene;
}

SceneDescription heavyDropped(uint32_t ratio) { return heavyAndLight(1, 0.1, ratio, "falls by 0.1 m onto"); }

SceneDescription heavyDroppedHard(uint32_t ratio) {
    SceneDescription scene = heavyDropped(ratio);
    scene.step.solver = SolverKind::Hard;
    return scene;
}

SceneDescription smallHeavyDropped(uint32_t ratio) {
    return heavyAndLight(0.1, 3, ratio, "falls by three edges of 10 cm onto");
}

SceneDescription largeHeavyDropped(uint32_t ratio) { return heavyAndLight(10, 0.3, ratio, "falls by 3 m, 0.3 edges, onto"); }

SceneDescription heavyPlaced(uint32_t ratio) { return heavyAndLight(1, 0, ratio, "lies on"); }

SceneDescription heavyCylinderDropped(uint32_t ratio) {
    SceneDescription scene = heavyDropped(ratio);
    scene.comment =
        "A cylinder of " + std::to_string(ratio) +
        " kg falls by 0.1 m onto a cube of 1 kg.\nPasses: after 10 s it is within 1 % of an edge of its place, upright "
        "and at rest.";
    BodyDescription& heavy = scene.bodies.back();
    heavy.shape.kind = ShapeKind::Hull;
    heavy.shape.points = cylinder(0.5, 1, 24);
    return scene;
}

SceneDescription tinyBodies(uint32_t) {
    SceneDescription scene =
        newScene("Cubes of 1, 2 and 3 mm, a ball of 2 mm and a cylinder of 15 mm fall by 2 cm.\n"
                 "Passes: after 60 s none lies deeper than a twentieth of its size, or moves faster than 1 mm/s. "
                 "The cylinder has not moved aside by 1 mm.",
                 0.3);
    scene.gravity = {0, -9.81, 0};
    scene.step.steps = 3600;
    addGround(scene);
    for (int k = 1; k <= 3; ++k) {
        const double edge = 1e-3 * k;
        addBox(scene, {edge, edge, edge}, {0.02 * k, 0.02, 0});
    }
    BodyDescription& ball = addBox(scene, {1, 1, 1}, {0.08, 0.02, 0});
    ball.shape.kind = ShapeKind::Ball;
    ball.shape.radius = 1e-3;
    addHull(scene, cylinder(7.5e-3, 0.01, 24), {-0.05, 0.02, 0});
    return scene;
}

} // namespace brittle::library
