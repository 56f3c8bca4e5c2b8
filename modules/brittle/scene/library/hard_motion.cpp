#include "modules/brittle/scene/library/hard_scenes.h"
#include "modules/brittle/scene/library/scene_parts.h"

namespace brittle::library {
namespace {

SceneDescription freeBody(const std::string& comment, const Double3& size, const Double3& spin) {
    SceneDescription scene = weightlessScene(comment + "\nPasses: angular momentum to 0.01 %, its direction to 0.1 degrees, "
                                                       "kinetic energy to 0.1 %.",
                                             3);
    scene.effects = {};
    scene.step.steps = 600;
    addBox(scene, size, {0, 0, 0}).spin = spin;
    return scene;
}

// A cube of 10 cm on its way along x.
void addShot(SceneDescription& scene, double x, double speed) {
    BodyDescription& shot = addBox(scene, {0.1, 0.1, 0.1}, {x, 0, 0});
    shot.name = "shot";
    shot.velocity = {speed, 0, 0};
}

} // namespace

SceneDescription intermediateAxis(uint32_t) {
    return freeBody("A box of 1 x 0.5 x 0.1 m turns at 10 rad/s about its middle axis, without contacts.", {1, 0.5, 0.1},
                    {0.01, 10, 0.01});
}

SceneDescription thinRod(uint32_t) {
    return freeBody("A rod of 2 m x 2 cm turns at 30 rad/s about an axis that is not its own.", {2, 0.02, 0.02}, {5, 30, 0});
}

SceneDescription cubeAtWall(uint32_t speed) {
    SceneDescription scene = weightlessScene("A cube of 10 cm hits a wall of 5 cm at " + std::to_string(speed) +
                                                 " m/s.\n"
                                                 "Passes: never through, comes back at 1 % of its speed or less.",
                                             6);
    scene.step.steps = 120;
    scene.effects.insert(scene.effects.end(), {"restitution", "ccd"});
    addShot(scene, 0, speed);
    ColliderDescription& wall = scene.colliders.emplace_back();
    wall.name = "wall";
    wall.shape = {.kind = ShapeKind::Box, .size = {0.05, 10, 10}};
    wall.place = {5, 0, 0};
    return scene;
}

SceneDescription cubeAtPlate(uint32_t speed) {
    SceneDescription scene = weightlessScene("A cube of 10 cm hits a free plate of 5 cm at " + std::to_string(speed) +
                                                 " m/s.\n"
                                                 "Passes: never through, momentum to 1e-4 %.",
                                             6);
    scene.step.steps = 120;
    scene.effects.insert(scene.effects.end(), {"restitution", "ccd"});
    addShot(scene, 0.02, speed);
    addBox(scene, {0.05, 2, 2}, {5, 0, 0}).name = "plate";
    return scene;
}

SceneDescription cubesHeadOn(uint32_t speed) {
    SceneDescription scene = weightlessScene("Two cubes meet at " + std::to_string(speed) +
                                                 " m/s each and bounce without loss.\n"
                                                 "Passes: velocities are reversed to 1e-3.",
                                             6);
    scene.step.steps = 60;
    scene.effects = {"contacts", "restitution", "ccd"};
    for (const double side : {-1.0, 1.0}) {
        BodyDescription& cube = addBox(scene, {1, 1, 1}, {side * 5, 0, 0});
        cube.velocity = {-side * speed, 0, 0};
        cube.surface = {.friction = 0, .restitution = 1};
    }
    return scene;
}

SceneDescription flatPlate(uint32_t millimeters) {
    SceneDescription scene = newScene("A plate of 1 m x " + std::to_string(millimeters) +
                                          " mm falls flat from 1 m.\n"
                                          "Passes: overlap at most a tenth of its thickness, at rest to 1e-4 m/s.",
                                      3);
    scene.step.steps = 600;
    addGround(scene);
    addBox(scene, {1, 1e-3 * millimeters, 1}, {0, 1, 0}).name = "plate";
    return scene;
}

SceneDescription slivers(uint32_t millimeters) {
    SceneDescription scene = newScene("Thirty wedges of 1 m x " + std::to_string(millimeters) +
                                          " mm fall on a heap.\n"
                                          "Passes: all numbers finite, at rest to 1e-4 m/s, overlap at most 1 mm.",
                                      6);
    scene.step.steps = 900;
    addGround(scene);
    Dice dice(5);
    // In four columns, far enough apart that none overlap however they are turned.
    const double spacing = 1.25;
    for (uint32_t k = 0; k < 30; ++k) {
        const Double3 tip = {dice.between(-0.2, 0.2), 1e-3 * millimeters, dice.between(-0.2, 0.2)};
        const uint32_t layer = k / 4, row = k / 2 % 2, column = k % 2;
        const Double3 place = {spacing * (column - 0.5), 1 + spacing * layer, spacing * (row - 0.5)};
        BodyDescription& sliver = addHull(scene, {{-0.5, 0, -0.3}, {0.5, 0, -0.3}, {0, 0, 0.5}, tip}, place);
        sliver.turn = dice.turn();
    }
    return scene;
}

// The tangent of the slope is one half.
SceneDescription slope(uint32_t friction_percent) {
    const double friction = 0.01 * friction_percent;
    SceneDescription scene =
        newScene(std::string("A cube on a slope of tangent 0.5 with friction ") + std::to_string(friction_percent) +
                     " %.\n"
                     "Passes: above 50 % it creeps by at most 1e-4 m in 5 s; at 45 % it slides by 22.36 m in "
                     "10 s, to 2 %.",
                 8);
    scene.step.steps = 600;
    const Quaternion down = turnAbout({0, 0, 1}, -std::atan(0.5));
    scene.colliders.push_back(plane({0, 0, 0}, down, {.friction = friction}));
    scene.colliders.back().name = "slope";
    const double tangent = 0.5, cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
    BodyDescription& cube = addBox(scene, {1, 1, 1}, {0.5 * sine, 0.5 * cosine, 0});
    cube.turn = down;
    cube.surface.friction = friction;
    return scene;
}

SceneDescription bounce(uint32_t restitution_percent) {
    const double restitution = 0.01 * restitution_percent;
    SceneDescription scene = newScene("A cube falls flat from 2 m with restitution " + std::to_string(restitution_percent) +
                                          " %.\n"
                                          "Passes: it rises to 2 m times the square of its restitution, to 2 %.",
                                      5);
    scene.step.steps = 120;
    scene.effects.emplace_back("restitution");
    addGround(scene, {.restitution = restitution});
    addBox(scene, {1, 1, 1}, {0, 2.5, 0}).surface.restitution = restitution;
    return scene;
}

} // namespace brittle::library
