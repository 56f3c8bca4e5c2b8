// What the built-in scenes are put together from.
#pragma once

#include "modules/brittle/scene/scene_description.h"

#include <cmath>
#include <numbers>
#include <random>

namespace brittle::library {

// The same numbers everywhere: the standard says what the engine draws, but not what its distributions make of it.
class Dice {
public:
    explicit Dice(uint64_t seed) : engine_(seed) {}
    double between(double lower, double upper) {
        return lower + (upper - lower) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(between(0, count)); }
    Double3 inBox(double half);
    Double3 direction(); // unit
    Quaternion turn();   // unit, evenly over all turns

private:
    std::mt19937_64 engine_;
};

inline Quaternion turnAbout(const Double3& unit_axis, double radians) {
    const double s = std::sin(radians / 2);
    // 0 is added so that none is -0, which reads badly in files.
    return {0 + s * unit_axis[0], 0 + s * unit_axis[1], 0 + s * unit_axis[2], std::cos(radians / 2)};
}

// The effects are gravity, contacts and friction; the camera looks at a stage of so many meters.
SceneDescription newScene(const std::string& comment, double stage);
// The same without gravity.
SceneDescription weightlessScene(const std::string& comment, double stage);

ColliderDescription plane(const Double3& place, const Quaternion& turn, SurfaceDescription surface);
void addGround(SceneDescription& scene, SurfaceDescription surface = {}); // y = 0
// Ground and four planes that face each other, so far from the middle.
void addPit(SceneDescription& scene, double half, SurfaceDescription surface);

BodyDescription& addBox(SceneDescription& scene, const Double3& size, const Double3& place);
BodyDescription& addHull(SceneDescription& scene, std::vector<Double3> points, const Double3& place);
// A box that is broken into so many cells of random sites, all of them at rest and without a gap.
BodyDescription& addBrokenBox(SceneDescription& scene, const Double3& size, const Double3& place, uint32_t cells);

// Of 12 to 20 points on an ellipsoid with radii from 0.3 to 0.55 m.
std::vector<Double3> randomHullPoints(Dice& dice);

} // namespace brittle::library
