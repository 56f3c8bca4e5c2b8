#include "modules/brittle/scene/library/hard_scenes.h"
#include "modules/brittle/scene/library/scene_parts.h"

namespace brittle::library {
namespace {

// Cubes on each other, with gaps of so many parts of an edge between them.
void addStack(SceneDescription& scene, uint32_t cubes, double edge, double gap, const Double3& foot) {
    for (uint32_t k = 0; k < cubes; ++k)
        addBox(scene, {edge, edge, edge}, {foot[0], foot[1] + edge * (0.5 + (1 + gap) * k), foot[2]});
}

// Sized for a card house of cards that are 1 m long, 2 cm thick and 0.8 m wide and lean 20 degrees.
constexpr double kCardLength = 1, kCardThickness = 0.02, kCardWidth = 0.8, kCardLean = 20 * std::numbers::pi / 180;
const double kLevelHeight = kCardLength * std::cos(kCardLean) + kCardThickness * std::sin(kCardLean);
const double kTentWidth = kCardLength * std::sin(kCardLean) + kCardThickness * std::cos(kCardLean);

void addTent(SceneDescription& scene, double x, double floor) {
    for (const double side : {-1.0, 1.0}) {
        BodyDescription& card =
            addBox(scene, {kCardThickness, kCardLength, kCardWidth}, {x + side * kTentWidth / 2, floor + kLevelHeight / 2, 0});
        card.turn = turnAbout({0, 0, 1}, side * kCardLean);
        card.surface.friction = 0.8;
    }
}

void addCardFloor(SceneDescription& scene, double x, double floor) {
    addBox(scene, {1.98 * kTentWidth, kCardThickness, kCardWidth}, {x, floor + kCardThickness / 2, 0}).surface.friction = 0.8;
}

} // namespace

SceneDescription stack(uint32_t cubes) {
    SceneDescription scene = newScene("A stack of " + std::to_string(cubes) +
                                          " cubes stands.\n"
                                          "Passes: sideways at most 1, 5, 30 mm at 10, 20, 40 cubes, at rest to 0.1 mm in the "
                                          "last 5 s, asleep within 10 s.",
                                      std::max(4.0, 0.9 * cubes));
    scene.step.steps = 900;
    scene.effects.emplace_back("sleeping");
    addGround(scene);
    addStack(scene, cubes, 1, 0, {0, 0, 0});
    return scene;
}

SceneDescription heavyOnLight(uint32_t ratio) {
    SceneDescription scene = newScene("A cube on one of the same size that weighs " + std::to_string(ratio) +
                                          " times less.\n"
                                          "Passes: overlap at most 3, 10, 20 mm at 10, 100, 1000 to 1, stands for 10 s.",
                                      4);
    scene.step.steps = 600;
    addGround(scene);
    addStack(scene, 2, 1, 0, {0, 0, 0});
    scene.bodies[0].density = 100;
    scene.bodies[1].density = 100.0 * ratio;
    return scene;
}

SceneDescription cardHouse(uint32_t levels) {
    SceneDescription scene = newScene("A house of cards with " + std::to_string(levels) +
                                          " levels, by friction alone.\n"
                                          "Passes: the top sinks by at most 5 mm in 10 s, and moves by at most 1e-5 m in the "
                                          "last 5 s.",
                                      1.6 * levels);
    scene.step.steps = 600;
    addGround(scene, {.friction = 0.8});
    double floor = 0;
    for (uint32_t tents = levels; tents > 0; --tents) {
        for (uint32_t k = 0; k < tents; ++k)
            addTent(scene, 2 * kTentWidth * (k - 0.5 * (tents - 1)), floor);
        floor += kLevelHeight;
        for (uint32_t k = 0; k + 1 < tents; ++k)
            addCardFloor(scene, 2 * kTentWidth * (k - 0.5 * (tents - 2)), floor);
        floor += kCardThickness;
    }
    return scene;
}

SceneDescription farStack(uint32_t kilometers) {
    SceneDescription scene = newScene("A stack of 6 cubes " + std::to_string(kilometers) +
                                          " km from the origin.\n"
                                          "Passes: within 1 mm of the same stack at the origin.",
                                      6);
    const double x = 1000.0 * kilometers;
    scene.step.steps = 600;
    scene.camera.eye[0] += x;
    scene.camera.target[0] += x;
    addGround(scene);
    addStack(scene, 6, 1, 0.05, {x, 0, 0});
    return scene;
}

SceneDescription shortStack(uint32_t cubes) {
    SceneDescription scene = stack(cubes);
    scene.comment = "A stack of " + std::to_string(cubes) +
                    " cubes, to compare with a reference in double precision.\n"
                    "Passes: one step to 1e-6, 120 steps to 1 mm.";
    scene.effects = {"gravity", "contacts", "friction"};
    scene.step.steps = 120;
    scene.step.most_substeps = scene.step.substeps; // the reference takes as many always
    return scene;
}

SceneDescription scaledStack(uint32_t edge_mm) {
    const double edge = 1e-3 * edge_mm;
    SceneDescription scene = newScene("Four cubes with edges of " + std::to_string(edge_mm) +
                                          " mm fall onto each other from a twentieth of their size.\n"
                                          "Passes: in units of the edge, the same as with other edges, to 5 %.",
                                      4 * edge);
    addGround(scene);
    addStack(scene, 4, edge, 0.05, {0, 0, 0});
    return scene;
}

SceneDescription weighedStack(uint32_t density) {
    SceneDescription scene = scaledStack(1000);
    scene.comment = "Four cubes of " + std::to_string(density) +
                    " kg/m3 fall onto each other from 5 cm.\n"
                    "Passes: the same as with other densities, to 5 %.";
    for (BodyDescription& body : scene.bodies)
        body.density = density;
    return scene;
}

SceneDescription restingBlock(uint32_t steps) {
    SceneDescription scene = newScene("A block rests on the ground for " + std::to_string(steps) +
                                          " steps.\n"
                                          "Passes: drift at most 1 mm.",
                                      4);
    scene.step.steps = steps;
    addGround(scene);
    addStack(scene, 1, 1, 0, {0, 0, 0});
    return scene;
}

} // namespace brittle::library
