// Hulls, bodies and pairs for the kernels of dynamics, built on the host, and what the narrow phase makes of them.
#pragma once

#include "modules/brittle/dynamics/hull_set.h"
#include "modules/brittle/dynamics/narrow_phase.h"
#include "shaders-spirv/shared/body.h"
#include "shaders-spirv/shared/breaking.h"
#include "shaders-spirv/shared/contact.h"
#include "shaders-spirv/shared/narrow_phase.h"
#include "tests/kernel/lab.h"
#include "tests/reference/convex.h"

#include <random>

namespace kernel_test {

using Place = std::array<double, 3>;
using Turn = std::array<double, 4>; // x, y, z, w

constexpr Turn kNoTurn = {0, 0, 0, 1};
Turn turnAbout(const Place& axis, double angle);
Turn after(const Turn& p, const Turn& q); // q first
Place turned(const Turn& q, const Place& p);

// A convex solid as a hull in its body's frame. Coordinates become floats, which the oracles then take as given.
struct Shape {
    std::vector<brittle::Float3> vertices;
    std::vector<std::vector<uint32_t>> loops;
};
Shape boxShape(const Place& half);
Shape triangleShape(const Place& a, const Place& b, const Place& c);
// What is left of the ball's box when so many random planes about it have cut; stretched along the axes.
Shape cellShape(std::mt19937& random, uint32_t planes, const Place& stretch);
double radiusOf(const Shape& shape); // about the mean of its vertices

struct PlacedShape {
    uint32_t shape = 0;
    Place place = {0, 0, 0};
    Turn turn = kNoTurn;
    Place velocity = {0, 0, 0};
    std::array<int32_t, 3> sector = {0, 0, 0};
    Place spin = {0, 0, 0};
    double inverse_mass = 1; // 0: it does not move
};

struct HullScene {
    std::vector<Shape> shapes;
    std::vector<PlacedShape> bodies; // one piece each
    std::vector<std::array<uint32_t, 2>> pairs;

    uint32_t add(const Shape& shape);
    // A pair of two new bodies; its index.
    uint32_t addPair(const PlacedShape& a, const PlacedShape& b);
    // As the device has them, in double, relative to the middle of body `about`'s sector.
    reference::Convex solidOf(uint32_t body, uint32_t about) const;
    gpu::BodyState stateOf(uint32_t body) const;
};

struct NarrowPhaseRun {
    brittle::NarrowPhaseOptions options;
    bool many_lanes = false;
    uint32_t repeats = 1;                     // of the dispatches, for times
    engine::KernelLibrary* kernels = nullptr; // the test program's own if null
    std::vector<gpu::Birth> births = {};      // where given, of bodies: kernels specialized with SIBLINGS_ID look at them
    uint32_t steps = 0;                       // that were made
    bool hides = false;                       // the first contact of a body hides sides
};
// Milliseconds of all repeats go to `milliseconds` where that is given.
std::vector<gpu::Manifold> manifoldsOf(const HullScene& scene, const NarrowPhaseRun& run = {}, double* milliseconds = nullptr);

} // namespace kernel_test
