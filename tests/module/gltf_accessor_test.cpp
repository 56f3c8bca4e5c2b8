// Numbers of glTF accessors: component types, strides, sparse elements, and counts without data.
#include "tests/support/gltf_builder.h"

#include <gtest/gtest.h>

using namespace support;
using brittle::Double3;
using nlohmann::json;

namespace {

// The cube with positions and indices as given.
template <class Position, class Index>
GltfBuilder cubeOf(Position one, bool is_normalized) {
    GltfBuilder builder;
    std::vector<Position> positions;
    for (const float p : cubePositions())
        positions.push_back(static_cast<Position>(p > 0 ? one : std::is_signed_v<Position> ? -one : 0));
    const auto shared = cubeIndices();
    const size_t position = builder.addAccessor(positions, "VEC3", 3, is_normalized);
    const size_t index = builder.addAccessor(std::vector<Index>(shared.begin(), shared.end()), "SCALAR", 1);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}})}});
    return builder;
}

void expectCube(const GltfBuilder& builder, double lower, double upper) {
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.lower, (Double3{lower, lower, lower}));
    EXPECT_EQ(model.upper, (Double3{upper, upper, upper}));
    EXPECT_NEAR(model.volume, std::pow(upper - lower, 3), 1e-6 * std::pow(upper - lower, 3));
}

TEST(GltfAccessor, ReadsEveryComponentType) {
    expectCube(cubeOf<float, uint32_t>(1.0f, false), -1, 1);
    expectCube(cubeOf<int8_t, uint8_t>(100, false), -100, 100);
    expectCube(cubeOf<uint8_t, uint16_t>(200, false), 0, 200);
    expectCube(cubeOf<int16_t, uint8_t>(30000, false), -30000, 30000);
    expectCube(cubeOf<uint16_t, uint8_t>(60000, false), 0, 60000);
}

TEST(GltfAccessor, DividesNormalizedIntegers) {
    expectCube(cubeOf<int8_t, uint8_t>(127, true), -1, 1);
    expectCube(cubeOf<uint8_t, uint8_t>(255, true), 0, 1);
    expectCube(cubeOf<int16_t, uint8_t>(32767, true), -1, 1);
    expectCube(cubeOf<uint16_t, uint8_t>(65535, true), 0, 1);
}

TEST(GltfAccessor, TheLeastNormalizedIntegerIsMinusOne) {
    GltfBuilder builder = cubeOf<int8_t, uint8_t>(127, true);
    for (char& byte : builder.buffer)
        if (byte == -127) byte = -128;
    expectCube(builder, -1, 1);
}

TEST(GltfAccessor, ReadsInterleavedViewsThatEndWithTheLastAttribute) {
    GltfBuilder builder;
    std::vector<float> mixed;
    const auto positions = cubePositions();
    for (size_t v = 0; v < 8; ++v) {
        mixed.insert(mixed.end(), {7, 7}); // texture coordinates
        mixed.insert(mixed.end(), positions.begin() + 3 * static_cast<std::ptrdiff_t>(v),
                     positions.begin() + 3 * static_cast<std::ptrdiff_t>(v) + 3);
    }
    const size_t view = builder.addView({reinterpret_cast<const char*>(mixed.data()), mixed.size() * sizeof(float)});
    builder.json["bufferViews"][view]["byteStride"] = 20;
    const auto accessor = [&](size_t offset, const char* type) {
        return builder.add(
            "accessors", {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 8}, {"type", type}});
    };
    const json attributes = {{"TEXCOORD_0", accessor(0, "VEC2")}, {"POSITION", accessor(8, "VEC3")}};
    const size_t indices = builder.addAccessor(cubeIndices(), "SCALAR", 1);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", attributes}, {"indices", indices}})}});
    expectCube(builder, -1, 1);
    EXPECT_EQ(readModel(builder).imported.corner_uvs[5], (brittle::Float2{7, 7}));
    builder.json["accessors"][1]["byteOffset"] = 12; // one float too far
    EXPECT_NE(readModel(builder).refusal.find("accessor 1: 8 elements reach beyond its buffer view"), std::string::npos);
    builder.json["accessors"][1]["byteOffset"] = 8;
    builder.json["bufferViews"][view]["byteStride"] = 8;
    EXPECT_NE(readModel(builder).refusal.find("byteStride of its buffer view is 8, must be 12 or more"), std::string::npos);
}

// Vertex 7 moves from (1, 1, 1) to (5, 5, 5).
json sparseOf(GltfBuilder& builder, const std::vector<uint8_t>& places, const std::vector<float>& values) {
    const size_t indices = builder.addView({reinterpret_cast<const char*>(places.data()), places.size()});
    const size_t view = builder.addView({reinterpret_cast<const char*>(values.data()), 4 * values.size()});
    return {{"count", places.size()},
            {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
            {"values", {{"bufferView", view}}}};
}

TEST(GltfAccessor, ReplacesSparseElements) {
    GltfBuilder builder = cubeFile();
    builder.json["accessors"][0]["sparse"] = sparseOf(builder, {7}, {5, 5, 5});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.refusal, "");
    EXPECT_EQ(model.lower, (Double3{-1, -1, -1}));
    EXPECT_EQ(model.upper, (Double3{5, 5, 5}));
}

TEST(GltfAccessor, SparseElementsWithoutAViewStandAmongZeros) {
    GltfBuilder builder = cubeFile();
    builder.json["accessors"][0].erase("bufferView");
    // Vertices 1, 2 and 4; all others stay at zero, and triangles with equal corners go.
    builder.json["accessors"][0]["sparse"] = sparseOf(builder, {1, 2, 4}, {2, 0, 0, 0, 3, 0, 0, 0, 4});
    const ReadModel model = readModel(builder);
    EXPECT_EQ(model.imported.positions.size(), 8u);
    EXPECT_EQ(model.lower, (Double3{0, 0, 0}));
    EXPECT_EQ(model.upper, (Double3{2, 3, 4}));
}

TEST(GltfAccessor, RefusesElementsThatAreReplacedTwice) {
    GltfBuilder builder = cubeFile();
    builder.json["accessors"][0]["sparse"] = sparseOf(builder, {7, 7}, {5, 5, 5, 6, 6, 6});
    EXPECT_EQ(readModel(builder).refusal, "accessor 0, sparse, indices: index 1 is there twice; export the file again");
}

TEST(GltfAccessor, RefusesSparseElementsOutOfRange) {
    GltfBuilder builder = cubeFile();
    builder.json["accessors"][0]["sparse"] = sparseOf(builder, {8}, {5, 5, 5});
    EXPECT_NE(readModel(builder).refusal.find("accessor 0, sparse, indices: index 0 is beyond the 8 elements"),
              std::string::npos);
    builder.json["accessors"][0]["sparse"]["count"] = 4000000000u;
    EXPECT_NE(readModel(builder).refusal.find("4000000000 elements reach beyond its buffer view"), std::string::npos);
}

// Changes one member of the cube's file and returns the refusal.
std::string refusalWith(const char* pointer, const json& value) {
    GltfBuilder builder = cubeFile();
    builder.json[json::json_pointer(pointer)] = value;
    return readModel(builder).refusal;
}

TEST(GltfAccessor, RefusalsSayWhatIsWrongAndWhere) {
    const std::pair<std::pair<const char*, json>, const char*> kCases[] = {
        {{"/accessors/0/count", 4000000000u},
         "accessor 0: 4000000000 elements reach beyond its buffer view, which has 96 bytes"},
        {{"/accessors/0/count", -1}, "accessor 0: count is -1, must be an integer from 0 to 2^53"},
        {{"/accessors/0/count", 1e300}, "accessor 0: count is 1e+300, must be an integer"},
        {{"/accessors/0/count", 8.5}, "accessor 0: count is 8.5, must be an integer"},
        {{"/accessors/0/count", "8"}, "accessor 0: count is string, must be an integer"},
        {{"/accessors/0/byteOffset", 9007199254740992u}, "accessor 0: 8 elements reach beyond its buffer view"},
        {{"/accessors/0/byteOffset", 18446744073709551615u}, "accessor 0: byteOffset is 18446744073709551615"},
        {{"/accessors/0/componentType", 5124}, "accessor 0: componentType is 5124, must be"},
        {{"/accessors/0/type", "VEC9"}, "accessor 0: type must be SCALAR"},
        {{"/accessors/0/type", "VEC2"}, "mesh 0, primitive 0, POSITION: accessor 0 is of type VEC2, must have 3 components"},
        {{"/accessors/0/bufferView", 9}, "accessor 0: bufferView 9 is not there; the file has 2"},
        {{"/accessors/1/componentType", 5122}, "accessor 1: componentType of indices must be 5121, 5123 or 5125"},
        {{"/accessors/1/type", "VEC2"}, "accessor 1: type of indices must be SCALAR"},
        {{"/bufferViews/0/byteLength", 1000}, "bufferView 0: byteOffset 0 and byteLength 1000 reach beyond the buffer"},
        {{"/bufferViews/0/byteOffset", 9007199254740992u}, "bufferView 0: byteOffset 9007199254740992"},
        {{"/bufferViews/0/buffer", 1}, "bufferView 0: buffer 1 is not there; the file has 1"},
        {{"/bufferViews/0/byteStride", 0}, "byteStride of its buffer view is 0, must be 12 or more"},
        {{"/accessors/0", 7}, "accessor 0: is number, must be a JSON object"},
        {{"/accessors", 7}, "the file: accessors is number, must be an array"},
    };
    for (const auto& [change, words] : kCases)
        EXPECT_NE(refusalWith(change.first, change.second).find(words), std::string::npos)
            << change.first << ": " << refusalWith(change.first, change.second);
}

TEST(GltfAccessor, ReadsIntegersThatAreWrittenAsFractions) { EXPECT_EQ(refusalWith("/accessors/0/count", 8.0), ""); }

TEST(GltfAccessor, CountsWithoutDataAreNotBelieved) {
    GltfBuilder builder = cubeFile();
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["count"] = 4000000000u;
    EXPECT_NE(
        readModel(builder).refusal.find("accessor 0: count is 4000000000, too large for an accessor without a buffer view"),
        std::string::npos);
}

TEST(GltfAccessor, RefusesNumbersThatAreNotFinite) {
    GltfBuilder builder = cubeFile();
    const float nan = std::nanf("");
    builder.buffer.replace(12 * 3, 4, reinterpret_cast<const char*>(&nan), 4);
    EXPECT_EQ(readModel(builder).refusal,
              "mesh 0, primitive 0, vertex 3: a coordinate is not a finite number; remove that vertex and export again");
}

TEST(GltfAccessor, NormalsOfBytesAreUnitVectors) {
    GltfBuilder builder = cubeFile();
    std::vector<int8_t> normals;
    for (int k = 0; k < 8; ++k)
        normals.insert(normals.end(), {0, 127, 0, 0}); // padded to 4 bytes
    const size_t accessor = builder.addAccessor(normals, "VEC3", 4, true);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = accessor;
    EXPECT_EQ(readModel(builder).imported.corner_normals[4], (brittle::Float3{0, 1, 0}));
}

TEST(GltfAccessor, TextureCoordinatesOfShortsRunFromZeroToOne) {
    GltfBuilder builder = cubeFile();
    const std::vector<uint16_t> uvs = {0, 65535, 0, 65535, 0, 65535, 0, 65535, 0, 65535, 0, 65535, 0, 65535, 0, 65535};
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = builder.addAccessor(uvs, "VEC2", 2, true);
    EXPECT_EQ(readModel(builder).imported.corner_uvs[4], (brittle::Float2{0, 1})); // v points down, as in the file
}

} // namespace
