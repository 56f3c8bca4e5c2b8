// Splinters of some millimeters, of every shape, thrown onto a plane: none gets through, and all come to rest.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using brittle::BodyDescription, brittle::Double3, brittle::SceneDescription, brittle::ShapeKind, brittle::operator-;
using support::SceneRun;

class Draw {
public:
    explicit Draw(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
    uint32_t below(uint32_t n) { return static_cast<uint32_t>(random_()) % n; }
    Double3 inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

private:
    std::mt19937 random_;
};

constexpr Double3 kForms[] = {{1, 1, 1}, {1, 0.1, 0.1}, {1, 0.7, 0.05}, {1, 0.3, 0.1}}; // chunks, needles, flakes, shards

// The hull of four points to a dozen in an ellipsoid of 0.5 to 6 mm.
std::vector<Double3> splinter(Draw& draw) {
    const Double3& form = kForms[draw.below(4)];
    const double size = draw.between(0.5e-3, 6e-3);
    std::vector<Double3> points;
    for (const Double3& corner : {Double3{1, 1, 1}, Double3{1, -1, -1}, Double3{-1, 1, -1}, Double3{-1, -1, 1}})
        points.push_back({size * form[0] * corner[0], size * form[1] * corner[1], size * form[2] * corner[2]});
    for (uint32_t more = draw.below(9); more > 0; --more) {
        const Double3 p = draw.inBox(1.2);
        points.push_back({size * form[0] * p[0], size * form[1] * p[1], size * form[2] * p[2]});
    }
    return points;
}

// So far apart that each has the plane to itself.
SceneDescription splintersAbovePlane(uint32_t count, uint32_t seed) {
    SceneDescription scene;
    scene.effects = {"gravity", "contacts", "friction"};
    scene.colliders.emplace_back();
    Draw draw(seed);
    for (uint32_t k = 0; k < count; ++k) {
        BodyDescription& body = scene.bodies.emplace_back();
        body.shape.kind = ShapeKind::Hull;
        body.shape.points = splinter(draw);
        body.density = 2500;
        body.place = {2.0 * (k % 64), draw.between(0.02, 0.5), 2.0 * (k / 64)};
        body.turn = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
        body.velocity = {draw.between(-1, 1), draw.between(-8, 0), draw.between(-1, 1)};
        body.spin = draw.inBox(200);
    }
    return scene;
}

// Of centers of mass. What is held back lies in the ground by half of its thickness upwards at most (hold_back), of which the
// least quarter is below the centroid of a convex solid. What is not held back goes by an eighth of its reach in a step
// (isSwift), and no point of a convex solid is further from its centroid than 3/4 of its length.
constexpr double kDeepestShare = (0.5 - 0.25) + 0.125 * 0.75; // of a splinter's length

double lengthOf(const std::vector<Double3>& points) {
    double longest = 0;
    for (const Double3& p : points)
        for (const Double3& q : points)
            longest = std::max(longest, brittle::length(p - q));
    return longest;
}

struct Outcome {
    double deepest = 0; // of centers of mass below the plane, ever, of lengths
    double fastest = 0; // m/s, in the end
};

Outcome thrownOntoPlane(uint32_t count, uint32_t seed) {
    SceneRun run(splintersAbovePlane(count, seed));
    Outcome out;
    for (uint32_t step = 0; step < 600; step += 5) {
        run.step(5);
        for (size_t b = 0; b < count; ++b)
            out.deepest = std::max(out.deepest, -run.place(b)[1] / lengthOf(run.scene().bodies[b].shape.points));
    }
    EXPECT_TRUE(run.isFinite());
    for (size_t b = 0; b < count; ++b)
        out.fastest = std::max(out.fastest, run.speed(b));
    return out;
}

constexpr double kStill = 0.01; // m/s

TEST(QuickSplinters, OnAPlaneStayOnIt) {
    const Outcome out = thrownOntoPlane(200, 1);
    EXPECT_LT(out.deepest, kDeepestShare);
    EXPECT_LT(out.fastest, kStill);
}

TEST(LongSplinters, OnAPlaneStayOnItByTheThousand) {
    const Outcome out = thrownOntoPlane(4000, 2);
    EXPECT_LT(out.deepest, kDeepestShare);
    EXPECT_LT(out.fastest, kStill);
}

} // namespace
