// Bodies that nothing can be done with, each in a scene that is sound otherwise: 25 by their numbers, 26 by their points.
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/library/scene_parts.h"

#include <limits>

namespace brittle {
namespace {

using namespace library;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();

SceneDescription soundScene(const std::string& name, const std::string& comment) {
    SceneDescription scene = newScene(comment, 4);
    scene.name = name;
    addGround(scene);
    addBox(scene, {1, 1, 1}, {0, 0.5, 0}).name = "sound";
    return scene;
}

template <class Spoil>
RefusedScene withBody(const std::string& name, const std::string& comment, std::string_view reason, const Spoil& spoil) {
    RefusedScene refused{soundScene("hard_25_" + name, comment), reason};
    BodyDescription& body = addBox(refused.scene, {1, 1, 1}, {2, 0.5, 0});
    body.name = "bad";
    spoil(body);
    return refused;
}

RefusedScene withPoints(const std::string& name, const std::string& comment, std::string_view reason,
                        const std::vector<Double3>& points) {
    RefusedScene refused{soundScene("hard_26_" + name, comment), reason};
    addHull(refused.scene, points, {2, 0.5, 0}).name = "bad";
    return refused;
}

} // namespace

std::vector<RefusedScene> refusedScenes() {
    using Body = BodyDescription;
    return {
        withBody("nan_place", "A body that is nowhere.", "nan", [](Body& b) { b.place[1] = kNan; }),
        withBody("nan_turn", "A body that is turned no way.", "nan", [](Body& b) { b.turn[3] = kNan; }),
        withBody("no_turn", "A body whose turn is 0.", "all 0",
                 [](Body& b) {
                     b.turn = {0, 0, 0, 0};
                 }),
        withBody("infinite_velocity", "A body that is infinitely fast.", "inf", [](Body& b) { b.velocity[0] = kInfinite; }),
        withBody("infinite_spin", "A body that turns infinitely fast.", "inf", [](Body& b) { b.spin[2] = -kInfinite; }),
        withBody("zero_mass", "A body that weighs nothing.", "'mass' is 0", [](Body& b) { b.mass = 0; }),
        withBody("negative_density", "A body that weighs less than nothing.", "'density' is -1",
                 [](Body& b) { b.density = -1; }),
        withBody("infinite_mass", "A body that cannot be moved.", "'mass' is inf", [](Body& b) { b.mass = kInfinite; }),
        withBody("zero_volume", "A box without a height.", "'size' holds 0", [](Body& b) { b.shape.size[1] = 0; }),
        withBody("dust", "A box too light for floats.", "weighs",
                 [](Body& b) {
                     b.shape.size = {1e-6, 1e-6, 1e-6};
                 }),
        withPoints("three_points", "Three points.", "too few points", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
        withPoints("coincident", "Six points in one place.", "coincident points", std::vector<Double3>(6, {1, 2, 3})),
        withPoints("collinear", "Points on one line.", "collinear points", {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}),
        withPoints("coplanar", "Points in one plane.", "coplanar points", {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}),
        withPoints("nearly_three", "Four points, two of which are one.", "too few points",
                   {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1 + 1e-7, 0}}),
        withPoints("nan_point", "A point that is nowhere.", "nan", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, kNan}}),
    };
}

} // namespace brittle
