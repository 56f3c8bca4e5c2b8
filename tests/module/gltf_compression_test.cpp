// Compressed glTF files: EXT_meshopt_compression and KHR_draco_mesh_compression. The tests compress with the libraries'
// encoders.
#include "tests/support/gltf_builder.h"

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

using namespace support;
using nlohmann::json;

namespace {

void expectCube(const ReadModel& model, double tolerance = 1e-6) {
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.volume, 8, tolerance);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(model.lower[c], -1, tolerance);
        EXPECT_NEAR(model.upper[c], 1, tolerance);
    }
}

// ---- meshopt ----------------------------------------------------------------------------------------------------------------

using Bytes = std::vector<unsigned char>;

Bytes encodeVertices(const void* vertices, size_t count, size_t stride) {
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, stride));
    return bytes;
}

Bytes encodeTriangles(const std::vector<uint32_t>& indices) {
    Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), 8));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

Bytes encodeSequence(const std::vector<uint32_t>& indices) {
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), 8));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

// A view of a fallback buffer without data, compressed in buffer 0.
size_t addCompressed(GltfBuilder& builder, const Bytes& bytes, size_t count, size_t stride, const char* mode,
                     const char* filter = "NONE") {
    const size_t view = builder.addView({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    json& element = builder.json["bufferViews"][view];
    json extension = element;
    extension.update({{"count", count}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}});
    element = {{"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", extension}}}};
    return view;
}

GltfBuilder withFallback(GltfBuilder builder) {
    builder.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}},
                               {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return builder;
}

size_t accessorOf(GltfBuilder& builder, size_t view, int component_type, size_t count, const char* type, bool is_normalized) {
    return builder.add("accessors", {{"bufferView", view},
                                     {"componentType", component_type},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", is_normalized}});
}

const auto kPositions = cubePositions();

std::vector<uint32_t> wideIndices() {
    const auto indices = cubeIndices();
    return {indices.begin(), indices.end()};
}

// The cube whose index view is given.
GltfBuilder cubeWithIndices(const Bytes& indices, const char* mode, size_t index_bytes) {
    GltfBuilder builder;
    const size_t vertices = addCompressed(builder, encodeVertices(kPositions.data(), 8, 12), 8, 12, "ATTRIBUTES");
    const size_t view = addCompressed(builder, indices, 36, index_bytes, mode);
    const size_t position = accessorOf(builder, vertices, 5126, 8, "VEC3", false);
    const size_t index = accessorOf(builder, view, index_bytes == 2 ? 5123 : 5125, 36, "SCALAR", false);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}})}});
    return withFallback(builder);
}

TEST(GltfMeshopt, ReadsAttributesTrianglesAndIndices) {
    for (const size_t index_bytes : {size_t{2}, size_t{4}}) {
        expectCube(readModel(cubeWithIndices(encodeTriangles(wideIndices()), "TRIANGLES", index_bytes)));
        expectCube(readModel(cubeWithIndices(encodeSequence(wideIndices()), "INDICES", index_bytes)));
    }
}

TEST(GltfMeshopt, ReadsTheExponentialFilter) {
    GltfBuilder builder;
    std::vector<uint32_t> filtered(24);
    meshopt_encodeFilterExp(filtered.data(), 8, 12, 15, kPositions.data());
    const size_t vertices = addCompressed(builder, encodeVertices(filtered.data(), 8, 12), 8, 12, "ATTRIBUTES", "EXPONENTIAL");
    const size_t position = accessorOf(builder, vertices, 5126, 8, "VEC3", false);
    const size_t index = builder.addAccessor(cubeIndices(), "SCALAR", 1);
    builder.addNode({{"mesh", builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", index}})}});
    expectCube(readModel(withFallback(builder)), 1e-3);
}

TEST(GltfMeshopt, ReadsTheOctahedralFilter) {
    const std::vector<float> normal = {0.6f, 0, 0.8f, 0};
    for (const size_t stride : {size_t{4}, size_t{8}}) {
        GltfBuilder builder = cubeFile();
        std::vector<float> normals;
        for (int k = 0; k < 8; ++k)
            normals.insert(normals.end(), normal.begin(), normal.end());
        Bytes filtered(8 * stride);
        meshopt_encodeFilterOct(filtered.data(), 8, stride, stride == 4 ? 8 : 16, normals.data());
        const size_t view =
            addCompressed(builder, encodeVertices(filtered.data(), 8, stride), 8, stride, "ATTRIBUTES", "OCTAHEDRAL");
        builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
            accessorOf(builder, view, stride == 4 ? 5120 : 5122, 8, "VEC3", true);
        const ReadModel model = readModel(withFallback(builder));
        expectCube(model);
        EXPECT_NEAR(model.imported.corner_normals[0][0], 0.6f, 0.01f);
        EXPECT_NEAR(model.imported.corner_normals[0][2], 0.8f, 0.01f);
    }
}

TEST(GltfMeshopt, ReadsTheQuaternionFilter) {
    GltfBuilder builder;
    builder.addMesh(cubePrimitive(builder));
    const float half = std::sqrt(0.5f);
    const std::vector<float> rotation = {0, 0, half, half}; // a quarter turn about z
    Bytes filtered(8);
    meshopt_encodeFilterQuat(filtered.data(), 1, 8, 16, rotation.data());
    const size_t view = addCompressed(builder, encodeVertices(filtered.data(), 1, 8), 1, 8, "ATTRIBUTES", "QUATERNION");
    const json attributes = {{"ROTATION", accessorOf(builder, view, 5122, 1, "VEC4", true)},
                             {"SCALE", builder.addAccessor(std::vector<float>{3, 1, 1}, "VEC3", 3)}};
    builder.addNode({{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    const ReadModel model = readModel(withFallback(builder));
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.upper[0], 1, 1e-3);
    EXPECT_NEAR(model.upper[1], 3, 1e-3);
}

TEST(GltfMeshopt, RefusalsSayWhatIsWrong) {
    const auto refusalWith = [](const char* member, const json& value) {
        GltfBuilder builder = cubeWithIndices(encodeTriangles(wideIndices()), "TRIANGLES", 2);
        builder.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][member] = value;
        return readModel(builder).refusal;
    };
    const std::string where = "bufferView 0, EXT_meshopt_compression: ";
    EXPECT_EQ(refusalWith("count", 4000000000u), where + "count is 4000000000, too large for its data; export the file again");
    EXPECT_EQ(refusalWith("count", 200), where + "its data is damaged or of a newer version; export the file again");
    EXPECT_EQ(refusalWith("byteStride", 10),
              where + "byteStride is 10, must be a multiple of 4 up to 256; export the file again");
    EXPECT_EQ(refusalWith("byteStride", 260),
              where + "byteStride is 260, must be a multiple of 4 up to 256; export the file again");
    EXPECT_EQ(refusalWith("mode", "TRIANGLES"), where + "byteStride is 12, must be 2 or 4 for indices; export the file again");
    EXPECT_EQ(refusalWith("mode", "SECRET"), where + "mode must be ATTRIBUTES, TRIANGLES or INDICES; export the file again");
    EXPECT_EQ(refusalWith("filter", "SECRET"), where + "its filter \"SECRET\" is not known; export the file again");
    EXPECT_EQ(refusalWith("filter", "OCTAHEDRAL"),
              where + "byteStride is 12, must be 4 or 8 for the filter OCTAHEDRAL; export the file again");
    EXPECT_EQ(refusalWith("filter", "QUATERNION"),
              where + "byteStride is 12, must be 8 for the filter QUATERNION; export the file again");
    EXPECT_EQ(refusalWith("byteLength", 4), where + "its data is damaged or of a newer version; export the file again");
    EXPECT_EQ(refusalWith("buffer", 1),
              "buffer 1: it has no data, yet a view without compression uses it; export the file again");
}

// ---- Draco ------------------------------------------------------------------------------------------------------------------

struct DracoFile {
    std::string bytes;
    uint32_t position_id = 0, normal_id = 0, vertices = 0;
};

DracoFile encodeCube(draco::MeshEncoderMethod method) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(12);
    const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = soup.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const auto indices = cubeIndices();
    const std::array<float, 3> up = {0, 0, 1};
    for (uint32_t t = 0; t < 12; ++t) {
        const auto at = [&](uint32_t k) { return &kPositions[size_t{3} * indices[3 * t + k]]; };
        soup.SetAttributeValuesForFace(position, draco::FaceIndex(t), at(0), at(1), at(2));
        soup.SetAttributeValuesForFace(normal, draco::FaceIndex(t), up.data(), up.data(), up.data());
    }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(position, 14);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {{buffer.data(), buffer.size()},
            mesh->attribute(position)->unique_id(),
            mesh->attribute(normal)->unique_id(),
            mesh->num_points()};
}

// The accessors have no views, as if the extension is required.
GltfBuilder dracoCube(const DracoFile& draco) {
    GltfBuilder builder;
    const auto accessor = [&](int component_type, size_t count, const char* type) {
        return builder.add("accessors", {{"componentType", component_type}, {"count", count}, {"type", type}});
    };
    const json attributes = {{"POSITION", accessor(5126, draco.vertices, "VEC3")},
                             {"NORMAL", accessor(5126, draco.vertices, "VEC3")}};
    const json extension = {{"bufferView", builder.addView(draco.bytes)},
                            {"attributes", {{"POSITION", draco.position_id}, {"NORMAL", draco.normal_id}}}};
    builder.addNode({{"mesh", builder.addMesh({{"attributes", attributes},
                                               {"indices", accessor(5123, 36, "SCALAR")},
                                               {"extensions", {{"KHR_draco_mesh_compression", extension}}}})}});
    builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return builder;
}

TEST(GltfDraco, ReadsBothEncodings) {
    for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const ReadModel model = readModel(dracoCube(encodeCube(method)));
        expectCube(model, 1e-3);
        EXPECT_NEAR(model.imported.corner_normals[7][2], 1, 1e-3);
    }
}

// Its accessors have their data as well, here of another cube.
TEST(GltfDraco, ReadsTheCompressedFormIfBothAreThere) {
    GltfBuilder builder = dracoCube(encodeCube(draco::MESH_EDGEBREAKER_ENCODING));
    builder.json["accessors"][0]["bufferView"] = builder.addView(std::string(8 * 12, '\0'));
    builder.json.erase("extensionsRequired");
    expectCube(readModel(builder), 1e-3);
}

TEST(GltfDraco, RefusalsSayWhatIsWrong) {
    const DracoFile draco = encodeCube(draco::MESH_EDGEBREAKER_ENCODING);
    GltfBuilder builder = dracoCube(draco);
    json& attributes = builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"];
    attributes["POSITION"] = 77;
    EXPECT_EQ(readModel(builder).refusal, "mesh 0, primitive 0: its Draco data has no attribute 77; export the file again");
    attributes["POSITION"] = draco.position_id;
    builder.json["accessors"][0]["type"] = "VEC2";
    EXPECT_EQ(readModel(builder).refusal, "mesh 0, primitive 0, POSITION: must have 3 components; export the file again");
    builder.json["accessors"][0]["type"] = "VEC3";
    attributes.erase("POSITION"); // then its accessor counts, here too short
    builder.json["accessors"][0]["count"] = 3;
    EXPECT_NE(readModel(builder).refusal, "");
    DracoFile cut = draco;
    cut.bytes.resize(cut.bytes.size() / 2);
    EXPECT_NE(readModel(dracoCube(cut)).refusal.find("mesh 0, primitive 0: its Draco data is damaged"), std::string::npos);
}

TEST(GltfDraco, SpoiledDataDoesNoHarm) {
    const DracoFile draco = encodeCube(draco::MESH_EDGEBREAKER_ENCODING);
    for (size_t at = 0; at < draco.bytes.size(); ++at)
        for (const int bit : {0, 3, 7}) {
            DracoFile spoiled = draco;
            spoiled.bytes[at] = static_cast<char>(spoiled.bytes[at] ^ (1 << bit));
            const ReadModel model = readModel(dracoCube(spoiled));
            EXPECT_EQ(model.refusal.find('\n'), std::string::npos);
        }
}

} // namespace
