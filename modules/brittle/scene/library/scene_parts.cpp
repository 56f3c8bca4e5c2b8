#include "modules/brittle/scene/library/scene_parts.h"

#include "modules/brittle/mesh/vector_math.h"

namespace brittle::library {

namespace {

// Numbers that a float holds, so that every engine the scene is given to sees the same.
Double3 rounded(const Double3& p) { return toDouble(toFloat(p)); }

} // namespace

Double3 Dice::inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

Double3 Dice::direction() {
    for (;;) {
        const Double3 p = inBox(1);
        const double size = length(p);
        if (size <= 1 && size > 0.1) return 1 / size * p;
    }
}

// Evenly over the sphere of four dimensions, for the reason that directions are drawn from a ball.
Quaternion Dice::turn() {
    for (;;) {
        const Quaternion q = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
        const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (size <= 1 && size > 0.1) return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
    }
}

SceneDescription newScene(const std::string& comment, double stage) {
    SceneDescription scene;
    scene.comment = comment;
    scene.gravity = {0, -10, 0};
    scene.camera.eye = {0.8 * stage, 0.7 * stage, 1.4 * stage};
    scene.camera.target = {0, 0.35 * stage, 0};
    return scene;
}

SceneDescription weightlessScene(const std::string& comment, double stage) {
    SceneDescription scene = newScene(comment, stage);
    scene.effects = {"contacts", "friction"};
    scene.camera.target = {0, 0, 0};
    return scene;
}

ColliderDescription plane(const Double3& place, const Quaternion& turn, SurfaceDescription surface) {
    ColliderDescription collider;
    collider.place = place;
    collider.turn = turn;
    collider.surface = surface;
    return collider;
}

void addGround(SceneDescription& scene, SurfaceDescription surface) {
    scene.colliders.push_back(plane({0, 0, 0}, {0, 0, 0, 1}, surface));
    scene.colliders.back().name = "ground";
}

void addPit(SceneDescription& scene, double half, SurfaceDescription surface) {
    addGround(scene, surface);
    const double quarter = std::numbers::pi / 2;
    scene.colliders.push_back(plane({-half, 0, 0}, turnAbout({0, 0, 1}, -quarter), surface));
    scene.colliders.push_back(plane({half, 0, 0}, turnAbout({0, 0, 1}, quarter), surface));
    scene.colliders.push_back(plane({0, 0, -half}, turnAbout({1, 0, 0}, quarter), surface));
    scene.colliders.push_back(plane({0, 0, half}, turnAbout({1, 0, 0}, -quarter), surface));
}

BodyDescription& addBox(SceneDescription& scene, const Double3& size, const Double3& place) {
    BodyDescription& body = scene.bodies.emplace_back();
    body.shape.size = size;
    body.place = place;
    return body;
}

BodyDescription& addHull(SceneDescription& scene, std::vector<Double3> points, const Double3& place) {
    BodyDescription& body = scene.bodies.emplace_back();
    body.shape.kind = ShapeKind::Hull;
    body.shape.points = std::move(points);
    body.place = place;
    return body;
}

BodyDescription& addBrokenBox(SceneDescription& scene, const Double3& size, const Double3& place, uint32_t cells) {
    BodyDescription& body = addBox(scene, size, place);
    body.name = "block";
    body.shape.cells.sites = cells;
    body.shape.cells.seed = 777;
    body.shape.cells.broken = true;
    return body;
}

std::vector<Double3> randomHullPoints(Dice& dice) {
    const uint32_t count = 12 + dice.below(9);
    const Double3 radii = {dice.between(0.3, 0.55), dice.between(0.3, 0.55), dice.between(0.3, 0.55)};
    std::vector<Double3> points;
    for (uint32_t k = 0; k < count; ++k) {
        const Double3 d = dice.direction();
        points.push_back(rounded({radii[0] * d[0], radii[1] * d[1], radii[2] * d[2]}));
    }
    return points;
}

} // namespace brittle::library
