// Nodes, scenes and instances of glTF files.
#include "modules/brittle/mesh/gltf/gltf.h"
#include "tests/support/gltf_builder.h"

#include <gtest/gtest.h>

using namespace support;
using brittle::Double3;
using nlohmann::json;

namespace {

// The cube's mesh without a node.
GltfBuilder cubeMesh() {
    GltfBuilder builder;
    builder.addMesh(cubePrimitive(builder));
    return builder;
}

ReadModel readWithNode(json node) {
    GltfBuilder builder = cubeMesh();
    node["mesh"] = 0;
    builder.addNode(node);
    return readModel(builder);
}

void expectBox(const ReadModel& model, const Double3& lower, const Double3& upper, double tolerance = 1e-12) {
    EXPECT_EQ(model.refusal, "");
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(model.lower[c], lower[c], tolerance);
        EXPECT_NEAR(model.upper[c], upper[c], tolerance);
    }
}

TEST(GltfScene, AppliesScaleThenRotationThenTranslation) {
    const double half = std::sqrt(0.5); // a quarter turn about z
    expectBox(readWithNode({{"translation", {10, 20, 30}}, {"rotation", {0, 0, half, half}}, {"scale", {1, 2, 3}}}),
              {8, 19, 27}, {12, 21, 33});
}

TEST(GltfScene, AppliesMatricesColumnByColumn) {
    expectBox(readWithNode({{"matrix", {0, 1, 0, 0, -2, 0, 0, 0, 0, 0, 3, 0, 10, 20, 30, 1}}}), {8, 19, 27}, {12, 21, 33});
}

TEST(GltfScene, KeepsDoublesFarFromTheOrigin) {
    expectBox(readWithNode({{"translation", {1e9, 0.125, -1e9}}}), {1e9 - 1, -0.875, -1e9 - 1}, {1e9 + 1, 1.125, -1e9 + 1}, 0);
}

TEST(GltfScene, RotationsNeedNotHaveLengthOne) {
    expectBox(readWithNode({{"rotation", {0, 0, 3, 3}}, {"scale", {1, 2, 3}}}), {-2, -1, -3}, {2, 1, 3});
}

TEST(GltfScene, MirroredNodesAreTurnedOver) {
    const ReadModel model = readWithNode({{"scale", {-1, 1, 1}}, {"translation", {5, 0, 0}}});
    expectBox(model, {4, -1, -1}, {6, 1, 1});
    EXPECT_FALSE(model.was_inside_out);
    EXPECT_NEAR(model.volume, 8, 1e-9);
}

TEST(GltfScene, ChildrenStandInTheirParents) {
    GltfBuilder builder = cubeMesh();
    builder.add("nodes", {{"mesh", 0}, {"translation", {0, 0, 1}}});
    builder.addNode({{"children", {0}}, {"scale", {2, 2, 2}}, {"translation", {0, 0, 10}}});
    expectBox(readModel(builder), {-2, -2, 10}, {2, 2, 14});
}

TEST(GltfScene, ReadsTheDefaultSceneAndNotesTheOthers) {
    GltfBuilder builder = cubeMesh();
    builder.addNode({{"mesh", 0}});
    builder.add("nodes", {{"mesh", 0}, {"translation", {100, 0, 0}}});
    builder.json["scenes"].push_back({{"nodes", {1}}});
    builder.json["scene"] = 1;
    const ReadModel model = readModel(builder);
    expectBox(model, {99, -1, -1}, {101, 1, 1});
    EXPECT_TRUE(hasNote(model, "1 other scene is left out: scene 1 is the default"));
    EXPECT_TRUE(hasNote(model, "1 node with a mesh is left out: the scene does not hold it"));
}

TEST(GltfScene, ReadsTheFirstSceneIfNoneIsTheDefault) {
    GltfBuilder builder = cubeMesh();
    builder.addNode({{"mesh", 0}});
    builder.json["scenes"].push_back({{"nodes", json::array()}});
    builder.json.erase("scene");
    const ReadModel model = readModel(builder);
    expectBox(model, {-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(model.notes, (std::vector<std::string>{"1 other scene is left out: scene 0 is the first"}));
}

TEST(GltfScene, ReadsAllNodesOfAFileWithoutScenes) {
    GltfBuilder builder = cubeMesh();
    builder.addNode({{"mesh", 0}});
    builder.json.erase("scene");
    builder.json.erase("scenes");
    const ReadModel model = readModel(builder);
    expectBox(model, {-1, -1, -1}, {1, 1, 1});
    EXPECT_TRUE(hasNote(model, "the file has no scene: all its nodes are read"));
}

TEST(GltfScene, NotesMeshesAndNodesThatAreInNoScene) {
    GltfBuilder builder = cubeMesh();
    builder.addNode({{"mesh", 0}});
    builder.add("nodes", {{"mesh", 0}});
    builder.add("nodes", {{"mesh", 0}});
    builder.addMesh(builder.json["meshes"][0]["primitives"][0]);
    const ReadModel model = readModel(builder);
    expectBox(model, {-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(model.notes, (std::vector<std::string>{"2 nodes with meshes are left out: the scene does not hold them",
                                                     "1 mesh is left out: no node uses it"}));
}

TEST(GltfScene, RefusesWhatIsNoTree) {
    const auto refusal = [](const json& nodes, const json& roots) {
        GltfBuilder builder = cubeMesh();
        builder.json["nodes"] = nodes;
        builder.json["scenes"][0]["nodes"] = roots;
        return readModel(builder).refusal;
    };
    const json leaf = {{"mesh", 0}}, first = {{"children", {1}}}, itself = {{"children", {0}}}, zero = {{"children", {0}}};
    EXPECT_EQ(refusal(json::array({itself}), {0}), "node 0: it lies within itself; export the file again");
    EXPECT_EQ(refusal({first, zero, leaf}, {2}), "node 0: it lies within itself; export the file again");
    EXPECT_EQ(refusal({first, leaf, first}, {0}), "node 1: it is a child of node 0 and again of node 2; export the file again");
    EXPECT_EQ(refusal({{{"children", {1, 1}}}, leaf}, {0}),
              "node 1: it is a child of node 0 and again of node 0; export the file again");
    EXPECT_EQ(refusal({first, leaf}, {0, 1}), "node 1: scene 0 lists it, yet it is a child of node 0; export the file again");
    EXPECT_EQ(refusal(json::array({leaf}), {0, 0}), "node 0: scene 0 lists it twice; export the file again");
    EXPECT_EQ(refusal(json::array({leaf}), {7}), "scene 0: node 7 is not there; the file has 1; export the file again");
    EXPECT_EQ(refusal({{{"children", {5}}}}, {0}), "node 0: node 5 is not there; the file has 1; export the file again");
    EXPECT_EQ(refusal({{{"mesh", 3}}}, {0}), "node 0: mesh 3 is not there; the file has 1; export the file again");
}

TEST(GltfScene, RefusesTransformsThatAreNone) {
    EXPECT_NE(readWithNode({{"rotation", {0, 0, 0, 0}}}).refusal.find("node 0: a rotation is no quaternion"),
              std::string::npos);
    EXPECT_NE(readWithNode({{"scale", {1, 2}}}).refusal.find("node 0: scale has 2 numbers, must have 3"), std::string::npos);
    EXPECT_NE(readWithNode({{"scale", {1, 2, "3"}}}).refusal.find("node 0: scale[2] is string, must be a number"),
              std::string::npos);
    EXPECT_NE(
        readWithNode({{"matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}).refusal.find("node 0: matrix must end"),
        std::string::npos);
    EXPECT_NE(readWithNode({{"translation", {1e308, 0, 0}}, {"scale", {1e308, 1e308, 1e308}}}).refusal, "");
}

TEST(GltfScene, ReadsALongChainOfNodes) {
    constexpr int kDepth = 100'000;
    GltfBuilder builder = cubeMesh();
    for (int k = 0; k < kDepth; ++k)
        builder.add("nodes", {{"children", {k + 1}}, {"translation", {0, 0, 0.5}}});
    builder.add("nodes", {{"mesh", 0}});
    builder.json["scenes"][0]["nodes"] = {0};
    expectBox(readModel(builder), {-1, -1, kDepth / 2 - 1}, {1, 1, kDepth / 2 + 1});
}

// ---- instances --------------------------------------------------------------------------------------------------------------

GltfBuilder threeInstances() {
    GltfBuilder builder = cubeMesh();
    const float half = std::sqrt(0.5f);
    const size_t t = builder.addAccessor(std::vector<float>{0, 0, 0, 10, 0, 0, 20, 0, 0}, "VEC3", 3);
    const size_t r = builder.addAccessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, half, half}, "VEC4", 4);
    const size_t s = builder.addAccessor(std::vector<float>{1, 1, 1, 2, 2, 2, 1, 3, 1}, "VEC3", 3);
    const json attributes = {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}};
    builder.addNode(
        {{"mesh", 0}, {"translation", {0, 0, 5}}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    return builder;
}

TEST(GltfScene, ReadsEveryInstanceOfANode) {
    const ReadModel model = readModel(threeInstances());
    expectBox(model, {-1, -2, 3}, {23, 2, 7}, 1e-6); // the last is three times as long, along x
    EXPECT_NEAR(model.volume, 8 + 64 + 24, 1e-4);
    EXPECT_EQ(model.imported.triangles.size(), 36u);
}

TEST(GltfScene, RefusesInstancesWithDifferentCounts) {
    GltfBuilder builder = threeInstances();
    builder.json["accessors"].back()["count"] = 2;
    EXPECT_NE(
        readModel(builder).refusal.find("node 0, EXT_mesh_gpu_instancing, attributes: its attributes have different counts"),
        std::string::npos);
}

// A hundred nodes of sixty thousand instances each would be 80 million triangles.
TEST(GltfScene, RefusesMoreInstancesThanItMayRead) {
    GltfBuilder builder = cubeMesh();
    const size_t zeros = builder.add("accessors", {{"componentType", 5126}, {"count", 60000}, {"type", "VEC3"}});
    const json extension = {{"attributes", {{"TRANSLATION", zeros}}}};
    for (int k = 0; k < 100; ++k)
        builder.addNode({{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", extension}}}});
    const auto read = brittle::readGltf(
        builder.glb(), [](const std::string&) { return std::string(); }, 1'000'000);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "mesh 0, primitive 0: with it and all instances there are more than 1000000 vertices or "
                                    "triangles; make the model simpler");
}

} // namespace
