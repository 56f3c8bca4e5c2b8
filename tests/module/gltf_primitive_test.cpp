// Primitives of glTF meshes: modes, morph targets, skins and texture coordinates.
#include "tests/support/gltf_builder.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace support;
using brittle::Double3;
using brittle::Float2;
using brittle::Index3;
using nlohmann::json;

namespace {

// ---- modes ------------------------------------------------------------------------------------------------------------------

// A file with one primitive of that mode: the five corners of a pyramid of height 1 over the square from 0 to 1.
GltfBuilder pyramid(int mode, const std::vector<uint8_t>& indices) {
    GltfBuilder builder;
    const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5f, 0.5f, 1};
    json primitive = {{"attributes", {{"POSITION", builder.addAccessor(positions, "VEC3", 3)}}}, {"mode", mode}};
    if (!indices.empty()) primitive["indices"] = builder.addAccessor(indices, "SCALAR", 1);
    builder.addNode({{"mesh", builder.addMesh(primitive)}});
    return builder;
}

json addPrimitive(GltfBuilder& builder, int mode, const std::vector<uint8_t>& indices) {
    json primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["mode"] = mode;
    primitive["indices"] = builder.addAccessor(indices, "SCALAR", 1);
    builder.json["meshes"][0]["primitives"].push_back(primitive);
    return primitive;
}

TEST(GltfPrimitive, ReadsTriangles) {
    const ReadModel model = readModel(pyramid(4, {0, 3, 2, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}));
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.volume, 1.0 / 3, 1e-6);
    EXPECT_FALSE(model.was_inside_out);
}

TEST(GltfPrimitive, ReadsAFanAndAStripThatCloseAPyramid) {
    GltfBuilder builder = pyramid(6, {4, 0, 1, 2, 3, 0}); // the sides
    addPrimitive(builder, 5, {0, 3, 1, 2});               // the base
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.volume, 1.0 / 3, 1e-6);
    EXPECT_FALSE(model.was_inside_out);
}

TEST(GltfPrimitive, EveryOtherTriangleOfAStripIsTurned) {
    const ReadModel model = readModel(pyramid(5, {0, 1, 3, 2}));
    EXPECT_EQ(model.imported.triangles, (std::vector<Index3>{{0, 1, 2}, {1, 3, 2}})); // places of 0, 1, 3, 2
}

TEST(GltfPrimitive, ReadsVerticesInOrderWithoutIndices) {
    GltfBuilder builder;
    std::vector<float> positions;
    const auto corners = cubePositions();
    for (const uint16_t index : cubeIndices())
        positions.insert(positions.end(), corners.begin() + 3 * index, corners.begin() + 3 * index + 3);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", builder.addAccessor(positions, "VEC3", 3)}}}})}});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.volume, 8, 1e-6);
}

TEST(GltfPrimitive, NotesPointsAndLines) {
    GltfBuilder builder = cubeFile();
    for (const int mode : {0, 1, 2, 3})
        addPrimitive(builder, mode, {0, 1});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.notes,
              (std::vector<std::string>{"4 primitives of points or lines are left out: only triangles can break"}));
}

TEST(GltfPrimitive, NotesCornersThatMakeNoTriangle) {
    GltfBuilder builder = cubeFile();
    addPrimitive(builder, 4, {0, 1});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_TRUE(hasNote(model, "2 last corners of primitives are left out: three make a triangle"));
}

TEST(GltfPrimitive, NotesPrimitivesWithoutPositions) {
    GltfBuilder builder = cubeFile();
    addPrimitive(builder, 4, {0, 1, 2})["attributes"] = json::object();
    builder.json["meshes"][0]["primitives"][1]["attributes"] = json::object();
    EXPECT_TRUE(hasNote(readModel(builder), "1 primitive without positions is left out"));
}

TEST(GltfPrimitive, KeepsOnlyVerticesThatTrianglesUse) {
    GltfBuilder builder = cubeFile();
    addPrimitive(builder, 4, {7, 1, 3});
    EXPECT_EQ(readModel(builder).imported.positions.size(), 8u + 3u);
}

TEST(GltfPrimitive, RefusalsSayWhatIsWrongAndWhere) {
    const auto refusalWith = [](const char* pointer, const json& value) {
        GltfBuilder builder = cubeFile();
        builder.json[json::json_pointer(pointer)] = value;
        return readModel(builder).refusal;
    };
    EXPECT_EQ(refusalWith("/meshes/0/primitives/0/mode", 7),
              "mesh 0, primitive 0: mode is 7, must be 0 to 6; export the file again");
    EXPECT_EQ(refusalWith("/meshes/0/primitives/0/indices", 9),
              "mesh 0, primitive 0, indices: accessor 9 is not there; the file has 2; export the file again");
    EXPECT_EQ(refusalWith("/accessors/0/count", 7),
              "mesh 0, primitive 0: index 8 is 7, it has 7 vertices; export the file again");
    EXPECT_EQ(refusalWith("/meshes/0/primitives/0/attributes/NORMAL", 1),
              "mesh 0, primitive 0, NORMAL: accessor 1 is of type SCALAR, must have 3 components; export the file again");
    EXPECT_EQ(refusalWith("/meshes/0/primitives", nullptr),
              "mesh 0: primitives is null, must be an array; export the file again");
    EXPECT_EQ(refusalWith("/nodes", json::array()), "scene 0: node 0 is not there; the file has 0; export the file again");
    EXPECT_EQ(refusalWith("/scenes/0/nodes", json::array()),
              "the scene: it has no triangles (1 node with a mesh is left out: the scene does not hold it); "
              "export the model with its meshes");
    EXPECT_EQ(refusalWith("/meshes/0/primitives/0/mode", 1),
              "the scene: it has no triangles (1 primitive of points or lines is left out: only triangles can break); "
              "export the model with its meshes");
}

TEST(GltfPrimitive, RefusesAttributesOfAnotherCount) {
    GltfBuilder builder = cubeFile();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        builder.addAccessor(std::vector<float>{0, 0, 1}, "VEC3", 3);
    EXPECT_EQ(readModel(builder).refusal, "mesh 0, primitive 0: NORMAL has 1 elements, POSITION has 8; export the file again");
}

// ---- morph targets ----------------------------------------------------------------------------------------------------------

// The cube with a target that lifts its upper face by 2 and one that widens it along x by 1 on each side.
GltfBuilder morphedCube() {
    GltfBuilder builder = cubeFile();
    std::vector<float> lift, widen;
    for (int k = 0; k < 8; ++k) {
        lift.insert(lift.end(), {0, 0, k & 4 ? 2.0f : 0.0f});
        widen.insert(widen.end(), {k & 1 ? 1.0f : -1.0f, 0, 0});
    }
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", builder.addAccessor(lift, "VEC3", 3)}},
                                                             {{"POSITION", builder.addAccessor(widen, "VEC3", 3)}}};
    return builder;
}

TEST(GltfPrimitive, AddsMorphTargetsByTheWeightsOfTheMesh) {
    GltfBuilder builder = morphedCube();
    EXPECT_EQ(readModel(builder).upper, (Double3{1, 1, 1}));
    builder.json["meshes"][0]["weights"] = {0.5, 1};
    EXPECT_EQ(readModel(builder).upper, (Double3{2, 1, 2}));
    EXPECT_NEAR(readModel(builder).volume, 4 * 2 * 3, 1e-6);
}

TEST(GltfPrimitive, WeightsOfTheNodeComeBeforeThoseOfTheMesh) {
    GltfBuilder builder = morphedCube();
    builder.json["meshes"][0]["weights"] = {1, 1};
    builder.json["nodes"][0]["weights"] = {0.5, 0};
    builder.addNode({{"mesh", 0}, {"translation", {10, 0, 0}}}); // by the weights of the mesh
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.lower, (Double3{-1, -1, -1}));
    EXPECT_EQ(model.upper, (Double3{12, 1, 3}));
    EXPECT_NEAR(model.volume, 12 + 4 * 2 * 4, 1e-5);
}

TEST(GltfPrimitive, MorphTargetsTurnNormals) {
    GltfBuilder builder = morphedCube();
    json& primitive = builder.json["meshes"][0]["primitives"][0];
    std::vector<float> normals, change;
    for (int k = 0; k < 8; ++k) {
        normals.insert(normals.end(), {1, 0, 0});
        change.insert(change.end(), {-1, 1, 0});
    }
    primitive["attributes"]["NORMAL"] = builder.addAccessor(normals, "VEC3", 3);
    primitive["targets"][0]["NORMAL"] = builder.addAccessor(change, "VEC3", 3);
    builder.json["meshes"][0]["weights"] = {1, 0};
    EXPECT_EQ(readModel(builder).imported.corner_normals[0], (brittle::Float3{0, 1, 0}));
}

TEST(GltfPrimitive, RefusesTargetsOfAnotherCount) {
    GltfBuilder builder = morphedCube();
    builder.json["meshes"][0]["weights"] = {1};
    builder.json["accessors"][2]["count"] = 7;
    EXPECT_EQ(readModel(builder).refusal,
              "mesh 0, primitive 0, target 0: POSITION has another count than that of the primitive; export the file again");
}

// ---- skins ------------------------------------------------------------------------------------------------------------------

// The lower face follows joint 0, the upper one joint 1, which stands 4 higher than its bind pose. The node of the mesh is
// far away, which does not count.
GltfBuilder skinnedCube(const std::vector<uint8_t>& weights_of_upper = {255, 0, 0, 0}) {
    GltfBuilder builder = cubeFile();
    std::vector<uint8_t> joints, weights;
    for (int k = 0; k < 8; ++k) {
        joints.insert(joints.end(), {static_cast<uint8_t>(k >> 2), 0, 0, 0});
        const std::vector<uint8_t> lower = {255, 0, 0, 0};
        const auto& of_vertex = k & 4 ? weights_of_upper : lower;
        weights.insert(weights.end(), of_vertex.begin(), of_vertex.end());
    }
    json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.addAccessor(joints, "VEC4", 4);
    attributes["WEIGHTS_0"] = builder.addAccessor(weights, "VEC4", 4, true);
    const std::vector<float> binds = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1,  // joint 0 at the origin
                                      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1}; // joint 1 at z = 1
    builder.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", builder.addAccessor(binds, "MAT4", 16)}});
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][0]["translation"] = {100, 0, 0};
    builder.add("nodes", {{"children", {2}}});
    builder.add("nodes", {{"translation", {0, 0, 5}}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    return builder;
}

TEST(GltfPrimitive, SkinsStandInTheirDefaultPose) {
    const ReadModel model = readModel(skinnedCube());
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.lower, (Double3{-1, -1, -1}));
    EXPECT_EQ(model.upper, (Double3{1, 1, 5}));
    EXPECT_NEAR(model.volume, 2 * 2 * 6, 1e-6);
}

TEST(GltfPrimitive, WeightsOfJointsAreNormalized) {
    const ReadModel model = readModel(skinnedCube({51, 51, 0, 0})); // 0.2 of each: half of the way
    EXPECT_EQ(model.upper, (Double3{1, 1, 3}));
}

TEST(GltfPrimitive, AVertexWithoutWeightsFollowsItsFirstJoint) {
    EXPECT_EQ(readModel(skinnedCube({0, 0, 0, 0})).upper, (Double3{1, 1, 5}));
}

TEST(GltfPrimitive, ReadsASecondSetOfJoints) {
    GltfBuilder builder = skinnedCube({51, 0, 0, 0});
    std::vector<uint8_t> joints, weights;
    for (int k = 0; k < 8; ++k) {
        joints.insert(joints.end(), {0, 0, 0, 0});
        weights.insert(weights.end(), {0, 0, static_cast<uint8_t>(k & 4 ? 153 : 0), 0});
    }
    json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = builder.addAccessor(joints, "VEC4", 4);
    attributes["WEIGHTS_1"] = builder.addAccessor(weights, "VEC4", 4, true);
    EXPECT_NEAR(readModel(builder).upper[2], 2, 1e-12); // a quarter of the way
    attributes.erase("WEIGHTS_1");
    EXPECT_NE(readModel(builder).refusal.find("JOINTS_1 and WEIGHTS_1 must both be there"), std::string::npos);
}

TEST(GltfPrimitive, MirroredJointsTurnTheirTrianglesOver) {
    GltfBuilder builder = skinnedCube();
    builder.json["nodes"][1]["scale"] = {-1, 1, 1};
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_FALSE(model.was_inside_out);
}

TEST(GltfPrimitive, ASkinWithoutJointsOfVerticesIsNoted) {
    GltfBuilder builder = skinnedCube();
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.upper, (Double3{101, 1, 1}));
    EXPECT_TRUE(hasNote(model, "mesh 0, primitive 0 has a skin but no joints: it stands where its node is"));
}

TEST(GltfPrimitive, RefusesSkinsThatDoNotFit) {
    const auto refusalWith = [](const char* pointer, const json& value) {
        GltfBuilder builder = skinnedCube();
        builder.json[json::json_pointer(pointer)] = value;
        return readModel(builder).refusal;
    };
    EXPECT_EQ(refusalWith("/skins/0/joints", {1}),
              "mesh 0, primitive 0: vertex 4 follows joint 1, its skin has 1; export the file again");
    EXPECT_EQ(refusalWith("/skins/0/joints", json::array()), "skin 0: joints are missing; export the file again");
    EXPECT_EQ(refusalWith("/skins/0/joints", {1, 9}), "skin 0: node 9 is not there; the file has 3; export the file again");
    EXPECT_EQ(refusalWith("/skins/0/joints", {1, 2, 1}),
              "skin 0: it has 3 joints but only 2 inverse bind matrices; export the file again");
    EXPECT_EQ(refusalWith("/nodes/0/skin", 4), "node 0: skin 4 is not there; the file has 1; export the file again");
}

// ---- texture coordinates ----------------------------------------------------------------------------------------------------

GltfBuilder texturedCube(const json& texture_info) {
    GltfBuilder builder = cubeFile();
    const std::vector<float> first(16, 0.25f);
    std::vector<float> second;
    for (int k = 0; k < 8; ++k)
        second.insert(second.end(), {0.5f, 0.75f});
    json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor(first, "VEC2", 2);
    primitive["attributes"]["TEXCOORD_1"] = builder.addAccessor(second, "VEC2", 2);
    primitive["material"] = builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture_info}}}});
    return builder;
}

Float2 uvOf(const json& texture_info) { return readModel(texturedCube(texture_info)).imported.corner_uvs[0]; }

void expectUv(const Float2& uv, float u, float v) {
    EXPECT_NEAR(uv[0], u, 1e-6f);
    EXPECT_NEAR(uv[1], v, 1e-6f);
}

TEST(GltfPrimitive, AppliesTheTransformOfTheTexture) {
    const auto transformed = [](json transform) {
        return json{{"index", 0}, {"extensions", {{"KHR_texture_transform", std::move(transform)}}}};
    };
    expectUv(uvOf({{"index", 0}}), 0.25f, 0.25f);
    expectUv(uvOf({{"index", 0}, {"texCoord", 1}}), 0.5f, 0.75f);
    expectUv(uvOf(transformed({{"texCoord", 1}})), 0.5f, 0.75f);
    expectUv(uvOf(transformed({{"offset", {1, 2}}, {"scale", {2, 4}}})), 1.5f, 3);
    // A quarter turn counter-clockwise, v down: what points along v then points along u.
    expectUv(uvOf(transformed({{"rotation", std::numbers::pi / 2}, {"scale", {0, 4}}})), 1, 0);
    EXPECT_NE(readModel(texturedCube(transformed({{"offset", {1}}}))).refusal.find("offset has 1 numbers, must have 2"),
              std::string::npos);
}

} // namespace
