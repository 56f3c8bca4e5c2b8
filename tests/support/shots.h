// Bodies of several shapes that fly at something, drawn by chance.
#pragma once

#include "modules/brittle/scene/scene_description.h"

#include <random>

namespace support {

struct Shot {
    const char* name;
    brittle::ShapeDescription shape;
};

inline const Shot kShots[] = {
    {"cube", {.kind = brittle::ShapeKind::Box, .size = {0.1, 0.1, 0.1}}},
    {"ball", {.kind = brittle::ShapeKind::Ball, .radius = 0.05, .corners = 24}},
    {"plate", {.kind = brittle::ShapeKind::Box, .size = {0.02, 0.5, 0.5}}},
    {"rod", {.kind = brittle::ShapeKind::Box, .size = {0.6, 0.05, 0.05}}},
    {"splinter", {.kind = brittle::ShapeKind::Hull, .points = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.02, 0}, {0.05, 0.01, 0.03}}}},
};

class ShotDraw {
public:
    explicit ShotDraw(uint32_t seed) : random_(seed) {}
    double upTo(double end) { return end * static_cast<double>(random_()) / 4294967296.0; }
    bool oneIn(uint32_t n) { return random_() % n == 0; }
    brittle::Turn turn() { return {upTo(2) - 1, upTo(2) - 1, upTo(2) - 1, upTo(2) - 1}; }

private:
    std::mt19937 random_;
};

// From some steps away on its way along x, turned and at times spinning.
inline brittle::BodyDescription& addShot(brittle::SceneDescription& scene, const Shot& shot, double speed, ShotDraw& draw) {
    brittle::BodyDescription& body = scene.bodies.emplace_back();
    body.name = shot.name;
    body.shape = shot.shape;
    body.place = {-2 - draw.upTo(1), 0.01, 0.02};
    body.turn = draw.turn();
    body.velocity = {speed, draw.oneIn(3) ? 0.5 * speed : 0, 0};
    if (draw.oneIn(3)) body.spin = {50, 0, 50};
    body.surface = {.friction = draw.oneIn(2) ? 0.6 : 0, .restitution = draw.oneIn(3) ? 0.5 : 0};
    return body;
}

} // namespace support
