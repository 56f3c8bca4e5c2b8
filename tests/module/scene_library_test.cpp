// The built-in scenes: all sound, all distinct, the same every time, and standing where they say.
#include "modules/brittle/scene/body_shape.h"
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/scene_file.h"
#include "tests/reference/hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace brittle;
using reference::operator+;
using reference::operator-;
using reference::operator*;

namespace {

SceneDescription made(std::string_view name) {
    const auto scene = makeBuiltinScene(name);
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? *scene : SceneDescription();
}

reference::Point turned(const Quaternion& q, const reference::Point& p) {
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const reference::Point u = {q[0] / size, q[1] / size, q[2] / size};
    const reference::Point t = 2 * reference::cross(u, p);
    return p + q[3] / size * t + reference::cross(u, t);
}

// A body's hull in the world, relative to `middle`.
reference::Convex placed(const BodyDescription& body, const Double3& middle) {
    const auto made_hull = hullOf(body.shape, {});
    EXPECT_TRUE(made_hull) << made_hull.error().message;
    reference::Convex solid;
    const Double3 place = body.place - middle;
    for (const Double3& v : made_hull->hull.vertices)
        solid.vertices.push_back(place + turned(body.turn, v));
    for (const ConvexHull::Face& face : made_hull->hull.faces) {
        const auto first = made_hull->hull.corners.begin() + face.first_corner;
        const reference::Point normal = turned(body.turn, face.normal);
        solid.faces.push_back({normal, face.height + reference::dot(normal, place), {first, first + face.corner_count}});
    }
    return solid;
}

struct Contact {
    double deepest_pair = -1e300, deepest_plane = -1e300; // m, negative where nothing touches
};

Contact contactsOf(const SceneDescription& scene) {
    Contact contact;
    const Double3 middle = scene.bodies.front().place;
    std::vector<reference::Convex> solids;
    for (const BodyDescription& body : scene.bodies)
        solids.push_back(placed(body, middle));
    for (size_t a = 0; a < solids.size(); ++a)
        for (size_t b = a + 1; b < solids.size(); ++b)
            contact.deepest_pair = std::max(contact.deepest_pair, reference::overlapOf(solids[a], solids[b]));
    for (const ColliderDescription& collider : scene.colliders) {
        if (collider.shape.kind != ShapeKind::Plane) continue;
        const reference::Point up = turned(collider.turn, {0, 1, 0});
        for (const reference::Convex& solid : solids)
            for (const reference::Point& v : solid.vertices)
                contact.deepest_plane = std::max(contact.deepest_plane, -reference::dot(up, v + middle - collider.place));
    }
    return contact;
}

TEST(SmallSceneLibrary, HasAllSceneNumbersButThoseThatAreNoScenes) {
    std::set<std::string> names, numbers;
    for (const SceneEntry& entry : builtinScenes()) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        if (entry.name.starts_with("hard_")) numbers.insert(entry.name.substr(5, 2));
    }
    for (const RefusedScene& refused : refusedScenes())
        numbers.insert(refused.scene.name.substr(5, 2));
    for (int k = 1; k <= 33; ++k) {
        const std::string number = (k < 10 ? "0" : "") + std::to_string(k);
        const bool waits = k == 21 || k == 27 || k == 28;
        EXPECT_EQ(numbers.count(number), waits ? 0u : 1u) << number;
    }
}

TEST(SceneLibrary, EverySceneIsSoundAndSaysWhatItIsFor) {
    for (const SceneEntry& entry : builtinScenes()) {
        SCOPED_TRACE(entry.name);
        const SceneDescription scene = made(entry.name);
        const auto checked = checkScene(scene);
        EXPECT_TRUE(checked) << checked.error().message;
        EXPECT_EQ(scene.name, entry.name);
        EXPECT_NE(scene.comment.find("\nPasses: "), std::string::npos);
    }
}

TEST(SmallSceneLibrary, ScenesSurviveAFile) {
    for (const char* name : {"hard_01_block_100", "hard_07_card_house", "hard_10_wall_300", "hard_16_slope_45", "hull_pile_100",
                             "hard_19_far_100km", "hard_15_slivers_1mm"}) {
        SCOPED_TRACE(name);
        const SceneDescription scene = made(name);
        const auto again = readScene(writeScene(scene), name);
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(*again, scene);
        EXPECT_EQ(made(name), scene);
    }
}

// gcc 12 once left the rounding of two of three coordinates out.
TEST(SmallSceneLibrary, PointsOfRandomHullsAreFloats) {
    const auto scene = brittle::makeBuiltinScene("hull_pile_100");
    ASSERT_TRUE(scene);
    for (const brittle::BodyDescription& body : scene->bodies)
        for (const brittle::Double3& point : body.shape.points)
            for (const double x : point)
                EXPECT_EQ(double{static_cast<float>(x)}, x) << body.name;
}

TEST(SmallSceneLibrary, FamiliesTakeANumber) {
    EXPECT_EQ(made("hull_pile_37").bodies.size(), 37u);
    EXPECT_EQ(made("stack_3").bodies.size(), 3u);
    for (const char* name : {"stack_0", "stack_", "stack_3x", "stack_-1", "stack_1001", "hull_pile_999999", "stak_10", ""})
        EXPECT_FALSE(makeBuiltinScene(name)) << name;
    EXPECT_NE(makeBuiltinScene("hard_07_card_hose").error().message.find("did you mean 'hard_07_card_house'?"),
              std::string::npos);
}

TEST(SmallSceneLibrary, WhatStandsTouchesWithoutOverlap) {
    for (const char* name : {"hard_05_stack_10", "hard_06_heavy_on_light_100", "hard_16_slope_45", "hard_33_rest"}) {
        SCOPED_TRACE(name);
        const Contact contact = contactsOf(made(name));
        EXPECT_LT(contact.deepest_pair, 1e-9);
        EXPECT_NEAR(contact.deepest_plane, 0, 1e-9);
    }
    EXPECT_NEAR(contactsOf(made("hard_03_overlap_10cm")).deepest_pair, 0.1, 1e-9);
    const Contact house = contactsOf(made("hard_07_card_house"));
    EXPECT_NEAR(house.deepest_plane, 0, 1e-9);
    EXPECT_LT(house.deepest_pair, 1e-9);
    EXPECT_GT(house.deepest_pair, -1e-3) << "cards that lean have to touch";
}

TEST(SmallSceneLibrary, WhatFallsBeginsApart) {
    for (const char* name : {"hull_pile_100", "hard_15_slivers_20mm", "hard_17_bounce_50", "hard_14_flat_plate_2mm"}) {
        SCOPED_TRACE(name);
        const Contact contact = contactsOf(made(name));
        EXPECT_LT(contact.deepest_plane, 0);
        EXPECT_LT(contact.deepest_pair, 0);
    }
    const Contact far = contactsOf(made("hard_19_far_100km"));
    EXPECT_NEAR(far.deepest_plane, 0, 1e-9);
    EXPECT_NEAR(far.deepest_pair, -0.05, 1e-9);
    EXPECT_LT(contactsOf(made("hard_17_bounce_50")).deepest_plane, -1.99);
}

TEST(SmallSceneLibrary, SpoiledScenesAreRefusedByTheNameOfTheBody) {
    for (const RefusedScene& refused : refusedScenes()) {
        SCOPED_TRACE(refused.scene.name);
        const auto checked = checkScene(refused.scene);
        ASSERT_FALSE(checked);
        EXPECT_EQ(checked.error().code, engine::ErrorCode::BadInput);
        EXPECT_EQ(checked.error().message.find("body 'bad': "), 0u) << checked.error().message;
        EXPECT_NE(checked.error().message.find(refused.reason), std::string::npos) << checked.error().message;
        EXPECT_TRUE(checkBody(refused.scene.bodies[0], 0));
        EXPECT_FALSE(checkBody(refused.scene.bodies[1], 1));
    }
}

// Four triangles a point, less four: 34 points have 64.
TEST(SmallBodyShape, BallsHaveAsManyPointsAsTheySay) {
    for (uint32_t corners = 4; corners <= kMaxBallCorners; ++corners) {
        const auto ball = hullOf({.kind = ShapeKind::Ball, .radius = 0.5, .corners = corners}, {});
        ASSERT_TRUE(ball) << corners << ": " << ball.error().message;
        EXPECT_EQ(ball->hull.vertices.size(), corners);
        EXPECT_LE(ball->hull.faces.size(), kMaxHullFaces);
        EXPECT_EQ(ball->notes.loosened, 0);
    }
}

TEST(SmallBodyShape, ModelsAreTakenByTheirVertices) {
    const auto cube = hullOf({.kind = ShapeKind::Hull, .file = "builtin:cube", .scale = {1, 2, 3}}, {});
    ASSERT_TRUE(cube) << cube.error().message;
    EXPECT_NEAR(cube->measures.volume, 6, 1e-12);
    const auto none = hullOf({.kind = ShapeKind::Hull, .file = "none.obj"}, "/no/such/folder");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("none.obj"), std::string::npos);
    EXPECT_FALSE(hullOf({.kind = ShapeKind::Mesh, .file = "builtin:cube"}, {}));
}

} // namespace
