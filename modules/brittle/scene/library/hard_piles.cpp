#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/library/hard_scenes.h"
#include "modules/brittle/scene/library/scene_parts.h"

#include <algorithm>

namespace brittle::library {

SceneDescription implosion(uint32_t hulls) {
    SceneDescription scene =
        weightlessScene(std::to_string(hulls) + " hulls fly at each other at 6 m/s, without bounce.\n"
                                                "Passes: kinetic energy never above that of the start, momentum to 1e-5 %, "
                                                "angular momentum to 0.02 %.",
                        16);
    Dice dice(99);
    for (uint32_t k = 0; k < hulls; ++k) {
        const Double3 outward = dice.direction();
        BodyDescription& body = addHull(scene, randomHullPoints(dice), dice.between(4, 10) * outward);
        body.turn = dice.turn();
        body.velocity = -6 * outward + dice.inBox(1);
        body.spin = dice.inBox(3);
    }
    return scene;
}

// In layers of a square, each hull with a cube of 1.25 m to itself.
SceneDescription hullPile(uint32_t hulls) {
    const double spacing = 1.25;
    const uint32_t side = std::max(3u, static_cast<uint32_t>(std::lround(std::cbrt(hulls))));
    SceneDescription scene =
        newScene(std::to_string(hulls) + " random hulls fall into a pit.\n"
                                         "Passes: 99 % of overlaps at most 5 mm, none above 30 mm, kinetic energy after 5 s at "
                                         "most 1e-3 J for every 1000.",
                 1.5 * spacing * side);
    scene.gravity = {0, -9.81, 0};
    addPit(scene, 0.5 * side * spacing + 0.3, {.friction = 0.5});
    Dice dice(12345);
    for (uint32_t k = 0; k < hulls; ++k) {
        const uint32_t layer = k / (side * side), row = k / side % side, column = k % side;
        const Double3 middle = {spacing * (column - 0.5 * (side - 1)), 1 + spacing * layer, spacing * (row - 0.5 * (side - 1))};
        const Double3 shift = {dice.between(-0.05, 0.05), 0, dice.between(-0.05, 0.05)};
        BodyDescription& body = addHull(scene, randomHullPoints(dice), middle + shift);
        body.turn = dice.turn();
        body.surface.friction = 0.5;
    }
    return scene;
}

SceneDescription overflow(uint32_t hulls) {
    SceneDescription scene = hullPile(hulls);
    scene.comment = "A pile of " + std::to_string(hulls) +
                    " hulls with room for 32 pairs and 32 contacts.\n"
                    "Passes: the overflow is reported and no contact is dropped in silence.";
    scene.budgets.pairs = 32;
    scene.budgets.contacts = 32;
    return scene;
}

SceneDescription longPile(uint32_t hulls) {
    SceneDescription scene = hullPile(hulls);
    scene.comment = "A pile of " + std::to_string(hulls) +
                    " hulls, run several times.\n"
                    "Passes: the same bits after 600 steps, whatever the threads, the size of workgroups, the order in which "
                    "bodies are added, and saving in between.";
    scene.step.steps = 600;
    return scene;
}

SceneDescription sleepyPile(uint32_t hulls) {
    SceneDescription scene = hullPile(hulls);
    scene.comment = "A pile of " + std::to_string(hulls) +
                    " hulls falls asleep.\n"
                    "Passes: all of it within 10 s, and costs nothing then.";
    scene.effects.emplace_back("sleeping");
    scene.step.steps = 600;
    return scene;
}

} // namespace brittle::library
