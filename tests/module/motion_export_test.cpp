// Bodies in motion as a GLB, read back by a reader of its own; and surfaces of bodies, that they are what was broken.
#include "modules/brittle/dynamics/scene_contents.h"
#include "modules/brittle/dynamics/scene_settings.h"
#include "modules/brittle/export/motion_glb.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/measures.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "tests/engine/test_device.h"
#include "tests/reference/motion_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

using namespace brittle;

namespace {

BodyDescription boxNamed(const std::string& name, const Double3& place) {
    BodyDescription body;
    body.name = name;
    body.shape.size = {1, 2, 3};
    body.place = place;
    return body;
}

// Two equal boxes over a plane, and a ball.
SceneDescription fewBodies() {
    SceneDescription scene;
    scene.bodies = {boxNamed("left", {-3, 4, 0}), boxNamed("right", {3, 5, 0}), boxNamed("ball", {0, 9, 0})};
    scene.bodies[1].turn = {0, std::sin(0.4), 0, std::cos(0.4)};
    scene.bodies[2].shape.kind = ShapeKind::Ball;
    scene.colliders.emplace_back().name = "ground";
    return scene;
}

struct Staged {
    WorldContents contents;
    WorldSurfaces surfaces;
};

Staged staged(const SceneDescription& scene) {
    const auto fracture = fractureFor(scene, engine_test::device());
    Staged made;
    auto contents = contentsOf(scene, ".", fracture->get(), &made.surfaces);
    EXPECT_TRUE(contents) << (contents ? "" : contents.error().message);
    if (contents) made.contents = std::move(*contents);
    return made;
}

Poses posesOf(const WorldContents& contents) {
    Poses poses;
    for (const gpu::BodyState& body : contents.bodies)
        poses.push_back(poseOf(body));
    return poses;
}

Turn aboutY(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }

class MotionExport : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path_); }
    reference::MotionFile read(const MotionGlb& motion) {
        const auto bytes = motion.encode();
        EXPECT_TRUE(bytes) << (bytes ? "" : bytes.error().message);
        std::ofstream(path_, std::ios::binary) << *bytes;
        return reference::readMotionFile(path_);
    }
    // Where the scene begins, and nothing after it.
    reference::MotionFile readBeginning(const SceneDescription& scene) {
        const Staged s = staged(scene);
        MotionGlb motion(s.surfaces, scene.camera, originOf(s.contents.bodies));
        EXPECT_TRUE(motion.add(0, posesOf(s.contents)));
        return read(motion);
    }
    const std::string path_ = testing::TempDir() + "brittle_motion_" + std::to_string(getpid()) + ".glb";
};

// The bodies of a file at its first moment, in the world.
struct Whole {
    reference::Triangles outer, all;
};
Whole wholeOf(const reference::MotionFile& file) {
    Whole whole;
    for (const reference::MovingBody& body : file.bodies) {
        const auto outer = placed(body.outer, body, 0), inner = placed(body.inner, body, 0);
        whole.outer.insert(whole.outer.end(), outer.begin(), outer.end());
        whole.all.insert(whole.all.end(), outer.begin(), outer.end());
        whole.all.insert(whole.all.end(), inner.begin(), inner.end());
    }
    return whole;
}

reference::Triangles trianglesOf(const ImportedMesh& mesh, const BodyDescription& body) {
    reference::Triangles triangles;
    for (const Index3& t : mesh.triangles) {
        reference::Triangle& triangle = triangles.emplace_back();
        for (size_t k = 0; k < 3; ++k) {
            reference::Point p = mesh.positions[t[k]];
            for (size_t c = 0; c < 3; ++c)
                p[c] *= body.shape.scale[c];
            const reference::Point turned = reference::turnedBy(body.turn, p);
            triangle[k] = {turned[0] + body.place[0], turned[1] + body.place[1], turned[2] + body.place[2]};
        }
    }
    return triangles;
}

SceneDescription tiltedRing(uint32_t sites, bool broken) {
    SceneDescription scene;
    BodyDescription& body = scene.bodies.emplace_back();
    body.name = "ring";
    body.shape.kind = ShapeKind::Mesh;
    body.shape.file = "builtin:ring";
    body.shape.scale = {1, 1.5, 0.8};
    body.shape.cells.sites = sites;
    body.shape.cells.broken = broken;
    body.place = {3, -2, 7};
    body.turn = {0.48, 0.6, 0, 0.64};
    return scene;
}

} // namespace

TEST_F(MotionExport, ReadsBackAsTheBodiesAndTheirMotion) {
    const SceneDescription scene = fewBodies();
    const Staged s = staged(scene);
    Poses poses = posesOf(s.contents);
    MotionGlb motion(s.surfaces, scene.camera, {0, 0, 0});
    ASSERT_TRUE(motion.add(0, poses));
    poses[0] = Pose{{-3, 1, 0.5}, aboutY(0.5)};
    ASSERT_TRUE(motion.add(0.25, poses));
    poses[0] = Pose{{-3, 1, 0.75}, aboutY(1)};
    ASSERT_TRUE(motion.add(1, poses));
    const reference::MotionFile file = read(motion);
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    EXPECT_EQ(file.times, (std::vector<double>{0, 0.25, 1}));
    ASSERT_EQ(file.bodies.size(), 4u);
    const reference::MovingBody& left = file.body("left");
    EXPECT_EQ(left.places, (std::vector<reference::Point>{{-3, 4, 0}, {-3, 1, 0.5}, {-3, 1, 0.75}}));
    EXPECT_NEAR(left.turns[2][1], std::sin(0.5), 1e-7);
    EXPECT_EQ(left.outer.size(), 12u);
    EXPECT_TRUE(left.inner.empty());
}

TEST_F(MotionExport, WhatStandsStillHasNoPartInTheAnimation) {
    const SceneDescription scene = fewBodies();
    const Staged s = staged(scene);
    Poses poses = posesOf(s.contents);
    MotionGlb motion(s.surfaces, scene.camera, {0, 0, 0});
    ASSERT_TRUE(motion.add(0, poses));
    poses[0]->place[1] = 3;
    ASSERT_TRUE(motion.add(1, poses));
    const reference::MotionFile file = read(motion);
    for (const reference::MovingBody& body : file.bodies)
        EXPECT_EQ(body.moves, body.name == "left") << body.name;
    EXPECT_EQ(readBeginning(scene).times.size(), 1u); // and nothing is animated at all
}

// "left" breaks into one fragment after the first moment; that one breaks in its turn.
TEST_F(MotionExport, WhatIsNotThereAllTheTimeHasAScaleOfZeroElsewhere) {
    const SceneDescription scene = fewBodies();
    Staged s = staged(scene);
    Poses poses = posesOf(s.contents);
    MotionGlb motion(s.surfaces, scene.camera, {0, 0, 0});
    ASSERT_TRUE(motion.add(0, poses));
    for (const char* name : {"left/0", "left/1", "left/2"})
        s.surfaces.bodies.push_back({0, name, true, false, 0});
    poses.resize(s.surfaces.bodies.size());
    poses[0].reset();
    poses[4] = Pose{{-3, 1, 0}, aboutY(3)};
    ASSERT_TRUE(motion.add(0.5, poses));
    poses[4]->place[1] = 0;
    ASSERT_TRUE(motion.add(1, poses));
    std::swap(poses[4], poses[5]);
    ASSERT_TRUE(motion.add(2, poses));
    const reference::MotionFile file = read(motion);
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    EXPECT_EQ(file.times, (std::vector<double>{0, 0.5, 1, 2}));
    EXPECT_EQ(file.body("left").there, (std::vector<bool>{true, false, false, false}));
    EXPECT_EQ(file.body("right").there, (std::vector<bool>{true, true, true, true}));
    EXPECT_EQ(file.body("left/0").there, (std::vector<bool>{false, true, true, false}));
    EXPECT_EQ(file.body("left/1").there, (std::vector<bool>{false, false, false, true}));
    EXPECT_EQ(file.body("left/0").places[1], (reference::Point{-3, 1, 0}));
    EXPECT_EQ(file.body("left/0").places[2], (reference::Point{-3, 0, 0}));
    EXPECT_EQ(file.bodies.size(), 6u); // what is never seen is not in it
}

TEST_F(MotionExport, EqualShapesShareAMesh) {
    const reference::MotionFile file = readBeginning(fewBodies());
    EXPECT_EQ(file.meshes, 3u);
    EXPECT_EQ(file.body("left").mesh, file.body("right").mesh);
    EXPECT_NE(file.body("left").mesh, file.body("ball").mesh);
    EXPECT_EQ(file.body("ground").still.size(), 2u);
}

TEST_F(MotionExport, TurnsTakeTheShortWayWhateverTheirSigns) {
    const SceneDescription scene = fewBodies();
    const Staged s = staged(scene);
    Poses poses = posesOf(s.contents);
    MotionGlb motion(s.surfaces, scene.camera, {0, 0, 0});
    for (int k = 0; k < 40; ++k) {
        poses[1]->turn = aboutY(0.3 * k);
        if (k % 3 == 0)
            for (double& x : poses[1]->turn)
                x = -x;
        ASSERT_TRUE(motion.add(0.1 * k, poses));
    }
    const reference::MotionFile file = read(motion);
    EXPECT_TRUE(file.faults.empty()) << file.faults.front();
    EXPECT_EQ(file.times.size(), 40u);
}

TEST_F(MotionExport, BodiesFarAwayKeepTheirBits) {
    SceneDescription scene = fewBodies();
    for (BodyDescription& body : scene.bodies)
        body.place[0] += 100'000.0625;
    const reference::MotionFile file = readBeginning(scene);
    EXPECT_GT(file.origin[0], 90'000);
    EXPECT_EQ(file.origin[0] + file.body("left").places[0][0], 100'000.0625 - 3);
}

TEST_F(MotionExport, TheCameraLooksAtItsTarget) {
    SceneDescription scene = fewBodies();
    scene.camera.eye = {7, 5, -2};
    scene.camera.target = {1, 1, 1};
    const reference::MotionFile file = readBeginning(scene);
    const reference::Point ahead = reference::turnedBy(file.view, {0, 0, -1}), up = reference::turnedBy(file.view, {0, 1, 0});
    const reference::Point way = reference::operator-({1, 1, 1}, {7, 5, -2});
    EXPECT_EQ(file.eye, (reference::Point{7, 5, -2}));
    EXPECT_NEAR(reference::dot(ahead, way), reference::length(way), 1e-6);
    EXPECT_GT(up[1], 0.5);
}

TEST_F(MotionExport, RefusesMomentsThatAreOneInTheFile) {
    const SceneDescription scene = fewBodies();
    const Staged s = staged(scene);
    MotionGlb motion(s.surfaces, scene.camera, {0, 0, 0});
    ASSERT_TRUE(motion.add(1000, posesOf(s.contents)));
    const auto again = motion.add(1000 + 1e-6, posesOf(s.contents));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, engine::ErrorCode::BadInput);
}

TEST_F(MotionExport, OtherReadersFindTheSameSurface) {
    const SceneDescription scene = tiltedRing(12, true);
    const reference::Triangles all = wholeOf(readBeginning(scene)).all;
    const auto imported = importMesh(path_);
    ASSERT_TRUE(imported) << imported.error().message;
    reference::Triangles triangles;
    for (const Index3& t : imported->triangles)
        triangles.push_back({imported->positions[t[0]], imported->positions[t[1]], imported->positions[t[2]]});
    EXPECT_EQ(triangles.size(), all.size());
    EXPECT_NEAR(reference::volumeOf(triangles), reference::volumeOf(all), 1e-5 * reference::volumeOf(all));
    EXPECT_NEAR(reference::areaOf(triangles), reference::areaOf(all), 1e-5 * reference::areaOf(all));
}

TEST_F(MotionExport, FragmentsAddUpToTheModelWhereItStands) {
    const SceneDescription scene = tiltedRing(25, true);
    const reference::MotionFile file = readBeginning(scene);
    EXPECT_GE(file.bodies.size(), 25u);
    const Whole whole = wholeOf(file);
    const reference::Triangles model = trianglesOf(makeTwistedRing(), scene.bodies[0]);
    const reference::Bounds bounds = reference::boundsOf(whole.all), expected = reference::boundsOf(model);
    EXPECT_NEAR(reference::volumeOf(whole.all), reference::volumeOf(model), 1e-5 * reference::volumeOf(model));
    EXPECT_NEAR(reference::areaOf(whole.outer), reference::areaOf(model), 1e-4 * reference::areaOf(model));
    EXPECT_LT(reference::length(reference::operator-(reference::centroidOf(whole.all), reference::centroidOf(model))), 1e-5);
    EXPECT_LT(reference::length(reference::operator-(bounds.lower, expected.lower)), 1e-5);
    EXPECT_LT(reference::length(reference::operator-(bounds.upper, expected.upper)), 1e-5);
}

TEST_F(MotionExport, WhatIsNotBrokenShowsTheModelsOwnSurface) {
    const SceneDescription scene = tiltedRing(25, false);
    const reference::MotionFile file = readBeginning(scene);
    ASSERT_EQ(file.bodies.size(), 1u);
    const Whole whole = wholeOf(file);
    const reference::Triangles model = trianglesOf(makeTwistedRing(), scene.bodies[0]);
    EXPECT_EQ(whole.all.size(), model.size());
    EXPECT_TRUE(file.bodies[0].inner.empty());
    EXPECT_NEAR(reference::volumeOf(whole.all), reference::volumeOf(model), 1e-5 * reference::volumeOf(model));
    EXPECT_LT(reference::length(reference::operator-(reference::centroidOf(whole.all), reference::centroidOf(model))), 1e-5);
}

TEST_F(MotionExport, SurfacesAreWhereTheirPiecesAre) {
    const SceneDescription scene = tiltedRing(15, true);
    const Staged s = staged(scene);
    for (size_t b = 0; b < s.contents.bodies.size(); ++b) {
        const SurfaceMesh& mesh = s.surfaces.meshes[s.surfaces.bodies[b].mesh];
        const gpu::HullRecord& hull = s.contents.hulls.records[s.contents.pieces[s.contents.shapes[b].pieces.x].ids.x];
        double furthest = 0;
        for (uint32_t f = 0; f < hull.count.y; ++f) {
            const gpu::vec4 plane = s.contents.hulls.faces[hull.first.y + f].plane;
            for (const FragmentVertex& v : mesh.vertices)
                furthest = std::max(furthest, double{plane.x} * v.position[0] + double{plane.y} * v.position[1] +
                                                  double{plane.z} * v.position[2] - double{plane.w});
        }
        EXPECT_LT(furthest, 1e-3 * hull.center.w) << s.surfaces.bodies[b].name;
    }
}

TEST_F(MotionExport, SurfacesThatNobodyAsksForChangeNothing) {
    const SceneDescription scene = tiltedRing(15, true);
    const Staged with = staged(scene);
    const auto fracture = Fracture::create(engine_test::device());
    ASSERT_TRUE(fracture);
    const auto without = contentsOf(scene, ".", fracture->get());
    ASSERT_TRUE(without);
    ASSERT_EQ(with.contents.bodies.size(), without->bodies.size());
    EXPECT_EQ(std::memcmp(with.contents.bodies.data(), without->bodies.data(), without->bodies.size() * sizeof(gpu::BodyState)),
              0);
}

// Their pieces have faces so thin that their corners, rounded, do not tell their planes.
TEST(SceneContents, FragmentsOfCurvedModelsAreBodies) {
    const auto fracture = Fracture::create(engine_test::device());
    ASSERT_TRUE(fracture);
    for (const char* model : {"builtin:ring", "builtin:bumpy:3", "builtin:icosphere:2"}) {
        SceneDescription scene = tiltedRing(60, true);
        scene.bodies[0].shape.file = model;
        const auto contents = contentsOf(scene, ".", fracture->get());
        ASSERT_TRUE(contents) << model << ": " << contents.error().message;
        EXPECT_GE(contents->bodies.size(), 60u);
    }
}

TEST(Pose, BetweenTwoLiesEvenlyOnTheShorterWay) {
    const Pose a = {{0, 0, 0}, aboutY(0)};
    Pose b = {{4, 8, -4}, aboutY(std::numbers::pi / 2)};
    for (double& x : b.turn)
        x = -x;
    const Pose middle = between(a, b, 0.25);
    EXPECT_EQ(middle.place, (Double3{1, 2, -1}));
    const reference::Point ahead = reference::turnedBy(middle.turn, {0, 0, 1});
    EXPECT_NEAR(ahead[0], std::sin(std::numbers::pi / 8), 1e-12);
    EXPECT_NEAR(ahead[2], std::cos(std::numbers::pi / 8), 1e-12);
}

TEST(Pose, BetweenTwoMomentsAreTheBodiesOfTheFirst) {
    const Pose low = {{0, 0, 0}, aboutY(0)}, high = {{0, 2, 0}, aboutY(0)};
    const Poses poses = between({low, low, std::nullopt}, {high, std::nullopt, high, high}, 0.5);
    ASSERT_EQ(poses.size(), 3u);
    EXPECT_EQ(poses[0]->place, (Double3{0, 1, 0}));
    EXPECT_EQ(poses[1]->place, low.place);
    EXPECT_FALSE(poses[2]);
}
