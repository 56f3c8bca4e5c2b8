// glTF files that break the specification: each is refused with the place, or read with a note. None is read in silence.
#include "tests/support/gltf_builder.h"

#include "modules/brittle/mesh/readers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

using namespace support;
using brittle::Double3;
using nlohmann::json;

namespace {

using Notes = std::vector<std::string>;

ReadModel readWithNode(const json& node) {
    GltfBuilder builder = cubeFile();
    builder.json["nodes"][0].update(node);
    return readModel(builder);
}

std::string utf16(const std::string& text, bool is_big_endian, bool has_mark) {
    std::string wide = !has_mark ? "" : is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text)
        wide += is_big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    return wide;
}

TEST(GltfInvalid, Utf16IsRefusedByName) {
    const std::string text = cubeFile().gltf();
    EXPECT_EQ(readModel(text).refusal, "");
    for (const bool is_big_endian : {false, true})
        for (const bool has_mark : {false, true})
            EXPECT_EQ(readModel(utf16(text, is_big_endian, has_mark)).refusal, brittle::kUtf16);
}

TEST(GltfInvalid, Version1IsRefusedByName) {
    const std::string nodes = R"("scene":"s","scenes":{"s":{"nodes":["n"]}},"nodes":{"n":{"meshes":["m"]}},"meshes":{"m":{}}})";
    EXPECT_EQ(readModel(R"({"asset":{"version":"1.0"},)" + nodes).refusal,
              "asset: version is \"1.0\", must be 2.0; convert the file to glTF 2.0");
    EXPECT_EQ(readModel(R"({"asset":{"version":1.0},)" + nodes).refusal,
              "asset: version is \"1.0\", must be 2.0; convert the file to glTF 2.0");
    EXPECT_EQ(readModel("{" + nodes).refusal, "the file: it is glTF 1.0, which is not read; convert the file to glTF 2.0");
    EXPECT_EQ(readModel(R"({"meshes":[]})").refusal, "the file: asset is missing; export the file again");
    std::string binary = cubeFile().glb();
    binary[4] = 1;
    EXPECT_EQ(readModel(binary).refusal, "the GLB header: version is 1, must be 2; convert the file to glTF 2.0");
}

TEST(GltfInvalid, AMatrixBesideOtherPartsMustAgreeWithThem) {
    const json matrix = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1};
    for (const json& parts : {json{{"translation", {5, 6, 7}}}, json{{"scale", {2, 2, 2}}}, json{{"rotation", {0, 0, 0, 1}}}}) {
        json node = parts;
        node["matrix"] = matrix;
        EXPECT_EQ(readWithNode(node).refusal,
                  "node 0: it has a matrix and a translation, rotation or scale that differs from it; remove one of them");
    }
    const ReadModel same = readWithNode({{"matrix", matrix}, {"translation", {5, 6, 7}}, {"scale", {2, 2, 2}}});
    EXPECT_EQ(same.lower, (Double3{3, 4, 5}));
    EXPECT_EQ(same.notes, Notes{"1 translation, rotation or scale is left out: the matrix of the node says the same"});
    EXPECT_EQ(readWithNode({{"matrix", matrix}}).notes, Notes{});
}

TEST(GltfInvalid, RotationsOfAnotherLengthAreNoted) {
    EXPECT_EQ(readWithNode({{"rotation", {0, 0, 3, 3}}}).notes,
              Notes{"1 rotation of another length than 1 is scaled to length 1"});
    EXPECT_EQ(readWithNode({{"rotation", {0, 0, 0.70711, 0.70711}}}).notes, Notes{});
}

TEST(GltfInvalid, NodesThatAScaleOfZeroMakesFlatAreLeftOut) {
    const std::string note = "1 node with a mesh is left out: a scale of 0 makes it flat";
    const json half_turned = {{"scale", {1, 0, 1}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}};
    EXPECT_EQ(readWithNode(half_turned).refusal,
              "the scene: it has no triangles (" + note + "); export the model with its meshes");
    GltfBuilder builder = cubeFile();
    builder.add("nodes", {{"mesh", 0}});
    builder.addNode({{"scale", {0, 0, 0}}, {"children", {1}}});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.notes, Notes{note});
    EXPECT_NEAR(model.volume, 8, 1e-9);
}

TEST(GltfInvalid, BytesBehindAGlbAreNoted) {
    const ReadModel model = readModel(cubeFile().glb() + std::string(16, 'x'));
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.notes, Notes{"16 bytes behind the GLB are left out: its header ends before them"});
}

// ---- component types --------------------------------------------------------------------------------------------------------

// The cube with positions of that type.
template <class T>
GltfBuilder cubeOf(bool is_normalized) {
    GltfBuilder builder = cubeFile();
    std::vector<T> positions;
    for (int k = 0; k < 8; ++k) {
        for (int axis = 0; axis < 3; ++axis)
            positions.push_back(k >> axis & 1 ? std::numeric_limits<T>::max() : T{0});
        positions.resize(positions.size() + (4 - 3 * sizeof(T) % 4) % 4 / sizeof(T)); // elements begin at multiples of 4 bytes
    }
    const size_t stride = positions.size() / 8;
    const size_t accessor = builder.addAccessor(positions, "VEC3", stride, is_normalized);
    builder.json["bufferViews"].back()["byteStride"] = stride * sizeof(T);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    return builder;
}

void expectNoteWithoutQuantization(GltfBuilder builder, const std::string& note, double size) {
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.upper, (Double3{size, size, size}));
    EXPECT_EQ(model.notes, Notes{note});
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        GltfBuilder declared = builder;
        declared.json[list] = {"KHR_mesh_quantization"};
        EXPECT_EQ(readModel(declared).notes, Notes{}) << list;
    }
}

TEST(GltfInvalid, IntegerPositionsWithoutTheirExtensionAreNoted) {
    expectNoteWithoutQuantization(
        cubeOf<uint8_t>(false),
        "mesh 0, primitive 0, POSITION: componentType 5121 is read, yet it is not allowed without KHR_mesh_quantization", 255);
    expectNoteWithoutQuantization(
        cubeOf<int16_t>(true),
        "mesh 0, primitive 0, POSITION: componentType 5122, normalized, is read, yet it is not allowed without "
        "KHR_mesh_quantization",
        1);
}

TEST(GltfInvalid, PositionsOf32BitIntegersAreRefused) {
    GltfBuilder builder = cubeOf<uint32_t>(false);
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(readModel(builder).refusal,
              "mesh 0, primitive 0, POSITION: componentType 5125 is for indices alone; export the file again");
}

TEST(GltfInvalid, IntegerNormalsAndTexturesWithoutTheExtensionAreNoted) {
    GltfBuilder builder = cubeFile();
    json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = builder.addAccessor(std::vector<uint16_t>(16, 1000), "VEC2", 2, true);
    EXPECT_EQ(readModel(builder).notes, Notes{});
    attributes["TEXCOORD_0"] = builder.addAccessor(std::vector<uint16_t>(16, 1000), "VEC2", 2);
    attributes["NORMAL"] = builder.addAccessor(std::vector<int8_t>(32, 64), "VEC3", 4, true);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.notes.size(), 2u);
    EXPECT_TRUE(hasNote(model, "NORMAL: componentType 5120, normalized, is read"));
    EXPECT_TRUE(hasNote(model, "TEXCOORD_0: componentType 5123 is read"));
}

// ---- skins and morph targets ------------------------------------------------------------------------------------------------

// The cube follows two joints, of which the second is shifted by 4 along z.
GltfBuilder skinnedCube(const std::vector<float>& weights_of_vertex) {
    GltfBuilder builder = cubeFile();
    std::vector<uint8_t> joints;
    std::vector<float> weights;
    for (int k = 0; k < 8; ++k) {
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), weights_of_vertex.begin(), weights_of_vertex.end());
    }
    json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.addAccessor(joints, "VEC4", 4);
    attributes["WEIGHTS_0"] = builder.addAccessor(weights, "VEC4", 4);
    builder.add("skins", {{"joints", {1, 2}}});
    builder.json["nodes"][0]["skin"] = 0;
    builder.addNode(json::object());
    builder.addNode({{"translation", {0, 0, 4}}});
    return builder;
}

TEST(GltfInvalid, JointWeightsThatDoNotAddUpAreScaledWithANote) {
    const ReadModel model = readModel(skinnedCube({0.25f, 0.25f, 0, 0}));
    EXPECT_EQ(model.upper, (Double3{1, 1, 3}));
    EXPECT_EQ(model.notes,
              Notes{"mesh 0, primitive 0: 8 vertices with joint weights that do not add up to 1: they are scaled to 1"});
    EXPECT_EQ(readModel(skinnedCube({0.5f, 0.5f, 0, 0})).notes, Notes{});
    EXPECT_EQ(readModel(skinnedCube({0.3333f, 0.6667f, 0, 0})).notes, Notes{});
}

TEST(GltfInvalid, VerticesWithoutJointWeightsAreNoted) {
    EXPECT_EQ(readModel(skinnedCube({0, 0, 0, 0})).notes,
              Notes{"mesh 0, primitive 0: 8 vertices without joint weights: the first joint moves them"});
}

TEST(GltfInvalid, JointsThatAreNoIntegersAreRefused) {
    GltfBuilder builder = skinnedCube({0.5f, 0.5f, 0, 0});
    json& joints = builder.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"];
    joints = builder.addAccessor(std::vector<float>(32, 0.5f), "VEC4", 4);
    EXPECT_EQ(readModel(builder).refusal,
              "mesh 0, primitive 0, attributes: JOINTS_0 must be unsigned integers of 8 or 16 bits; "
              "export the file again");
    joints = builder.addAccessor(std::vector<float>(32, 1), "VEC4", 4);
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.upper, (Double3{1, 1, 5}));
    EXPECT_EQ(model.notes, Notes{"mesh 0, primitive 0, JOINTS_0: componentType 5126 is read, yet it is not allowed"});
}

TEST(GltfInvalid, WeightsWithoutMorphTargetsAreNoted) {
    GltfBuilder builder = cubeFile();
    builder.json["nodes"][0]["weights"] = {0.5, 0, 1};
    EXPECT_EQ(readModel(builder).notes, Notes{"2 weights are left out: a primitive has fewer morph targets"});
    builder.json["nodes"][0]["weights"] = {0, 0, 0};
    EXPECT_EQ(readModel(builder).notes, Notes{});
}

// ---- KHR_texture_transform --------------------------------------------------------------------------------------------------

// Texture coordinates of the cube's first corner, (0.25, 0.5) in the file.
brittle::Float2 transformedUv(const json& transform) {
    GltfBuilder builder = cubeFile();
    std::vector<float> uvs;
    for (int k = 0; k < 8; ++k)
        uvs.insert(uvs.end(), {0.25f, 0.5f});
    json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor(uvs, "VEC2", 2);
    const json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    primitive["material"] = builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
    return readModel(builder).imported.corner_uvs[0];
}

void expectUv(const brittle::Float2& uv, float u, float v) {
    EXPECT_NEAR(uv[0], u, 1e-6f);
    EXPECT_NEAR(uv[1], v, 1e-6f);
}

// Example of the specification: "only the lower left quadrant of the source image, rotated clockwise 90 degrees". v points
// down, so that quadrant has u from 0 to 0.5 and v from 0.5 to 1. A rotation of the other sign would leave it.
TEST(GltfTextureTransform, TheExampleOfTheSpecificationUsesTheLowerLeftQuadrant) {
    expectUv(transformedUv({{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}}), 0.25f, 0.875f);
}

// Scale: (2 * 0.25, 3 * 0.5) = (0.5, 1.5). Rotation by 90 degrees: (u, v) -> (v, -u) = (1.5, -0.5). Offset: (11.5, 19.5).
TEST(GltfTextureTransform, ScalesThenRotatesThenShifts) {
    expectUv(transformedUv({{"offset", {10, 20}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}}), 11.5f, 19.5f);
    // By 30 degrees: (cos * 0.5 + sin * 1.5, -sin * 0.5 + cos * 1.5) with cos = 0.8660254 and sin = 0.5.
    expectUv(transformedUv({{"rotation", std::numbers::pi / 6}, {"scale", {2, 3}}}), 1.1830127f, 1.0490381f);
}

} // namespace
