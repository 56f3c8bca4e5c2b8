// Tests the buffers that a host draws a world from: triangles that its commands and matrices give, against the boxes of the
// scene.
#include "modules/brittle/dynamics/pose.h"
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "tests/engine/read_view.h"
#include "tests/engine/test_device.h"
#include "tests/module/breaking_scenes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace {

using namespace breaking_scenes;
using Eigen::Vector3d, Eigen::Quaterniond;
using engine_test::device, engine_test::valuesOf;

const brittle::Double3 kOrigin = {1000, 20, -3}; // m, that matrices count from
const Vector3d kSize(0.3, 0.2, 0.1);
const Vector3d kBreaks(1000.3, 20.1, -3.2), kWhole(1001.5, 20.5, -3); // centers

brittle::BodyDescription box(const Vector3d& place, const char* material) {
    brittle::BodyDescription body;
    body.material = material;
    body.shape.size = {kSize.x(), kSize.y(), kSize.z()};
    body.place = {place.x(), place.y(), place.z()};
    body.turn = {0.2, 0.3, 0.25, 0.9};
    return body;
}

std::unique_ptr<brittle::World> drawnWorld() {
    brittle::SceneDescription scene = sceneOf({box(kBreaks, "glass"), box(kWhole, "")}, false);
    scene.effects = {"contacts", "impact_fracture", "events"};
    scene.bodies[1].velocity = {1, 2, 3};
    scene.bodies[1].spin = {1, -2, 4};
    brittle::WorldSurfaces surfaces;
    auto contents = brittle::contentsOf(scene, {}, nullptr, &surfaces);
    EXPECT_TRUE(contents);
    brittle::addLooks(*contents, surfaces);
    auto world = brittle::World::create(device(), *contents, *brittle::settingsOf(scene), {});
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

struct Drawn {
    std::vector<gpu::DrawCommand> commands;
    std::vector<gpu::ObjectMatrix> matrices;
    std::vector<gpu::DrawnBody> bodies;
    std::vector<gpu::SceneVertex> vertices;
    std::vector<uint32_t> indices;

    explicit Drawn(brittle::World& world) {
        EXPECT_TRUE(world.updateDraws(kOrigin));
        const auto buffers = world.drawBuffers();
        commands = valuesOf<gpu::DrawCommand>(buffers->commands);
        matrices = valuesOf<gpu::ObjectMatrix>(buffers->matrices);
        bodies = valuesOf<gpu::DrawnBody>(buffers->bodies);
        vertices = valuesOf<gpu::SceneVertex>(buffers->vertices);
        indices = valuesOf<uint32_t>(buffers->indices);
        EXPECT_EQ(commands.size(), buffers->draw_count);
    }

    // Corners of a draw's triangles in the world, m; none if it has no instance.
    std::vector<Vector3d> cornersOf(size_t draw) const {
        std::vector<Vector3d> corners;
        const gpu::DrawCommand& c = commands[draw];
        const uint32_t slot = c.first_instance / 2;
        float m[16];
        std::memcpy(m, &matrices[slot], sizeof m); // by columns
        const Eigen::Matrix4d model = Eigen::Map<const Eigen::Matrix4f>(m).cast<double>();
        for (uint32_t k = 0; k < c.index_count * c.instance_count; ++k) {
            const float* p = vertices[indices[c.first_index + k]].position;
            const Eigen::Vector4d place = model * Eigen::Vector4d(p[0], p[1], p[2], 1);
            corners.emplace_back(place.head<3>() + Vector3d(kOrigin[0], kOrigin[1], kOrigin[2]));
        }
        return corners;
    }
};

// About a place near the triangles, so that little cancels.
double volumeOf(const std::vector<Vector3d>& corners, const Vector3d& about) {
    double volume = 0;
    for (size_t k = 0; k + 2 < corners.size(); k += 3)
        volume += (corners[k] - about).dot((corners[k + 1] - about).cross(corners[k + 2] - about)) / 6;
    return volume;
}

// How far a place is from the surface of a box, m.
double distanceToBox(const Vector3d& place, const Vector3d& center, const Quaterniond& turn) {
    const Vector3d depth = kSize / 2 - (turn.conjugate() * (place - center)).cwiseAbs();
    return std::abs(depth.minCoeff());
}

const Quaterniond kTurn = Quaterniond(0.9, 0.2, 0.3, 0.25).normalized();

TEST(SmallDrawing, ShowsBodiesAsTheyAreAtTheBeginning) {
    const auto world = drawnWorld();
    const Drawn drawn(*world);
    for (size_t body = 0; body < 2; ++body) {
        const Vector3d center = body == 0 ? kBreaks : kWhole;
        const auto corners = drawn.cornersOf(2 * body);
        ASSERT_EQ(corners.size(), 36u);
        for (const Vector3d& corner : corners)
            EXPECT_LT(((kTurn.conjugate() * (corner - center)).cwiseAbs() - kSize / 2).norm(), 1e-5);
        EXPECT_NEAR(volumeOf(corners, center), kSize.prod(), 1e-6);
        EXPECT_TRUE(drawn.cornersOf(2 * body + 1).empty()) << "no cut faces";
        EXPECT_EQ(drawn.bodies[body].body, body);
        EXPECT_EQ(drawn.bodies[body].step_made, 0u);
    }
    for (size_t draw = 4; draw < drawn.commands.size(); ++draw)
        EXPECT_EQ(drawn.commands[draw].instance_count, 0u) << "no body is in its slot";
}

TEST(SmallDrawing, MovesAndTurnsWhatMovesAndTurns) {
    const auto world = drawnWorld();
    step(*world, 30);
    const Drawn drawn(*world);
    const brittle::Pose pose = brittle::poseOf((*world->bodies())[1]);
    const Vector3d center(pose.place[0], pose.place[1], pose.place[2]);
    EXPECT_LT((center - kWhole - 0.5 * Vector3d(1, 2, 3)).norm(), 1e-3);
    // The axes of its vertices are the principal ones, so the triangles show how far it has turned from the beginning.
    const auto before = Drawn(*drawnWorld()).cornersOf(2), after = drawn.cornersOf(2);
    ASSERT_EQ(after.size(), before.size());
    Eigen::Matrix3Xd from(3, before.size()), to(3, before.size());
    for (size_t k = 0; k < before.size(); ++k) {
        from.col(static_cast<Eigen::Index>(k)) = before[k] - kWhole;
        to.col(static_cast<Eigen::Index>(k)) = after[k] - center;
    }
    const Eigen::Matrix3d turn = to * from.transpose() * (from * from.transpose()).inverse();
    EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-4) << "it stays as it is";
    EXPECT_LT((turn * from - to).norm(), 1e-4);
    EXPECT_GT(Eigen::AngleAxisd(turn).angle(), 1.5) << "half a second at 4.6 radians per second";
}

TEST(SmallDrawing, ShowsFragmentsInThePlaceOfABodyThatBreaks) {
    const auto world = drawnWorld();
    ASSERT_TRUE(world->strike({{kBreaks.x(), kBreaks.y() + 0.2, kBreaks.z()}, 0.2, 2000}));
    step(*world);
    const auto fragments = world->fragments();
    ASSERT_GT(fragments->size(), 10u);
    const Drawn drawn(*world);
    EXPECT_TRUE(drawn.cornersOf(0).empty()) << "the box is gone";
    double volume = 0, least = 1;
    for (const brittle::BodyFragment& fragment : *fragments) {
        auto corners = drawn.cornersOf(size_t{2} * fragment.slot);
        for (const Vector3d& corner : corners)
            EXPECT_LT(distanceToBox(corner, kBreaks, kTurn), 1e-5) << "outer faces are those of the box";
        const auto cuts = drawn.cornersOf(size_t{2} * fragment.slot + 1);
        EXPECT_FALSE(cuts.empty());
        corners.insert(corners.end(), cuts.begin(), cuts.end());
        volume += volumeOf(corners, kBreaks);
        least = std::min(least, volumeOf(corners, kBreaks));
        EXPECT_EQ(drawn.bodies[fragment.slot].step_made, 1u);
        EXPECT_EQ(drawn.bodies[fragment.slot].origin, 0u);
        EXPECT_EQ(drawn.bodies[fragment.slot].left, 1.0f);
    }
    const double dust = double{world->breaks()->events[0].offset.w} / 2500; // m3, of cells too small for bodies
    EXPECT_NEAR(volume + dust, kSize.prod(), 1e-6);
    EXPECT_GT(least, 0);
}

} // namespace
