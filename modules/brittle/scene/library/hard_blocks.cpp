#include "modules/brittle/scene/library/hard_scenes.h"
#include "modules/brittle/scene/library/scene_parts.h"

namespace brittle::library {

SceneDescription weightlessBlock(uint32_t cells) {
    SceneDescription scene = weightlessScene("A block of " + std::to_string(cells) +
                                                 " touching cells, without gravity, stays where it is.\n"
                                                 "Passes: speed at most 1e-4 m/s, drift at most 1e-4 m.",
                                             4);
    addBrokenBox(scene, {2, 2, 2}, {0, 0, 0}, cells);
    return scene;
}

SceneDescription standingBlock(uint32_t cells) {
    SceneDescription scene = newScene("A block of " + std::to_string(cells) +
                                          " touching cells stands on the ground.\n"
                                          "Passes: mean drift at most 0.10 m, 99 % of overlaps at most 2 mm, kinetic energy at "
                                          "the end at most 1e-3 J.",
                                      4);
    addGround(scene);
    addBrokenBox(scene, {2, 2, 2}, {0, 1, 0}, cells);
    return scene;
}

SceneDescription overlappingCubes(uint32_t millimeters) {
    SceneDescription scene =
        weightlessScene("Two cubes that overlap by " + std::to_string(millimeters) +
                            " mm come apart gently, without gravity.\n"
                            "Passes: speed at most 0.05 m/s, overlap below 1 mm after 2 s, kinetic energy at the end at most "
                            "1e-3 J.",
                        3);
    scene.step.steps = 120;
    addBox(scene, {1, 1, 1}, {0, 0, 0}).name = "lower";
    addBox(scene, {1, 1, 1}, {0, 1 - 1e-3 * millimeters, 0}).name = "upper";
    return scene;
}

SceneDescription inflatedBlock(uint32_t micrometers) {
    SceneDescription scene = weightlessScene("A block of 100 cells, each larger by " + std::to_string(micrometers) +
                                                 " micrometers on all sides, comes apart gently, without gravity.\n"
                                                 "Passes: no piece faster than 0.2 m/s.",
                                             4);
    addBrokenBox(scene, {2, 2, 2}, {0, 0, 0}, 100).shape.cells.inflate = 1e-6 * micrometers;
    return scene;
}

SceneDescription farBody(uint32_t cells) {
    SceneDescription scene =
        weightlessScene(std::to_string(cells) + " cells in a cubic meter and one body 10 km away, which takes all keys of a "
                                                "coarse grid.\n"
                                                "Passes: all pairs are found, in at most twice the time.",
                        2);
    scene.step.steps = 10;
    addBrokenBox(scene, {1, 1, 1}, {0, 0, 0}, cells);
    addBox(scene, {1, 1, 1}, {10'000, 0, 0}).name = "far";
    return scene;
}

SceneDescription crowdedSlab(uint32_t cubes) {
    SceneDescription scene = newScene("A slab with " + std::to_string(cubes) +
                                          " cubes on it: one body with more contacts than there are colors.\n"
                                          "Passes: no contact is dropped, at most twice the time.",
                                      20);
    scene.step.steps = 120;
    addGround(scene);
    const uint32_t side = static_cast<uint32_t>(std::ceil(std::sqrt(cubes)));
    const double spacing = 0.5, width = spacing * side + 1;
    addBox(scene, {width, 0.5, width}, {0, 0.25, 0}).name = "slab";
    for (uint32_t k = 0; k < cubes; ++k) {
        const uint32_t row = k / side, column = k % side;
        const double x = spacing * (column - 0.5 * (side - 1)), z = spacing * (row - 0.5 * (side - 1));
        addBox(scene, {0.4, 0.4, 0.4}, {x, 0.7, z});
    }
    return scene;
}

} // namespace brittle::library
