// Containers, buffers and extensions of glTF files.
#include "modules/brittle/mesh/import.h"
#include "tests/support/folder_test.h"
#include "tests/support/gltf_builder.h"

#include <fstream>

using namespace support;
using nlohmann::json;

namespace {

void expectCube(const ReadModel& model) {
    EXPECT_EQ(model.refusal, "");
    EXPECT_NEAR(model.volume, 8, 1e-6);
}

// ---- text and GLB -------------------------------------------------------------------------------------------------------

TEST(GltfFile, ReadsTextAndBinaryByTheirFirstBytes) {
    expectCube(readModel(cubeFile().glb()));
    expectCube(readModel(cubeFile().gltf()));
    expectCube(readModel("\xEF\xBB\xBF" + cubeFile().gltf()));
}

// JSON and BIN chunk of the cube.
std::pair<std::string, std::string> chunksOfCube() {
    GltfBuilder builder = cubeFile();
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}}};
    return {builder.json.dump(), builder.buffer};
}

const std::string kBinary("BIN\0", 4);

TEST(GltfFile, SkipsUnknownChunks) {
    const auto [text, binary] = chunksOfCube();
    expectCube(readModel(glbOf({{"JSON", text}, {"ABCD", "something"}, {kBinary, binary}, {"EFGH", ""}})));
    expectCube(readModel(glbOf({{"JSON", "\xEF\xBB\xBF" + text}, {kBinary, binary}})));
    expectCube(readModel(glbOf({{"JSON", text + std::string(8, '\0')}, {kBinary, binary}})));
    expectCube(readModel(glbOf({{"JSON", text}, {kBinary, binary}}) + "bytes behind the end"));
}

TEST(GltfFile, RefusesBrokenContainers) {
    const auto [text, binary] = chunksOfCube();
    const std::string whole = glbOf({{"JSON", text}, {kBinary, binary}});
    const auto refusal = [](const std::string& bytes) { return readModel(bytes).refusal; };
    EXPECT_EQ(refusal("glTF"), "the GLB header: is cut short; copy or export the file again");
    EXPECT_EQ(refusal(whole.substr(0, 100)), "the GLB header: promises " + std::to_string(whole.size()) +
                                                 " bytes, the file has 100; copy or export the file again");
    std::string first = whole;
    first[4] = 1;
    EXPECT_EQ(refusal(first), "the GLB header: version is 1, must be 2; convert the file to glTF 2.0");
    std::string long_chunk = whole;
    long_chunk[15] = '\x7f';
    EXPECT_EQ(refusal(long_chunk), "chunk 0: is longer than the file; copy or export the file again");
    EXPECT_EQ(refusal(glbOf({{kBinary, binary}, {"JSON", text}})),
              "chunk 0: is not JSON, as the first chunk must be; export the file again");
    EXPECT_EQ(refusal(glbOf({})), "chunk 0: is missing or empty, must be JSON; export the file again");
    EXPECT_EQ(refusal(glbOf({{"JSON", text}})),
              "buffer 0: it has no uri, and the file has no BIN chunk for it; export the file again");
    EXPECT_EQ(refusal(glbOf({{"JSON", text}, {kBinary, "short"}})),
              "buffer 0: byteLength is 168, its data has 8 bytes; copy or export the file again");
}

TEST(GltfFile, RefusesBrokenJson) {
    const auto refusal = [](const std::string& text) { return readModel(text).refusal; };
    EXPECT_EQ(refusal("{\"asset\":"), "the JSON: cannot be read at byte 10; export the file again");
    EXPECT_EQ(refusal("[]"), "the JSON: is array, must be an object; export the file again");
    EXPECT_EQ(refusal("{}"), "the file: asset is missing; export the file again");
    EXPECT_EQ(refusal("{\"asset\":{\"version\":1e999}}"),
              "the JSON: cannot be read: a number is too large; export the file again");
}

TEST(GltfFile, ReadsNamesInLatin1) {
    GltfBuilder builder = cubeFile();
    builder.json["nodes"][0]["name"] = "NAME";
    std::string text = builder.gltf();
    text.replace(text.find("NAME"), 4, "b\xFC\xE9\xFF");
    expectCube(readModel(text));
}

TEST(GltfFile, DeepJsonDoesNoHarm) {
    constexpr size_t kDepth = 100'000;
    EXPECT_NE(readModel(std::string(kDepth, '[')).refusal, "");
    EXPECT_NE(readModel(std::string(kDepth, '[') + std::string(kDepth, ']')).refusal, "");
    GltfBuilder builder = cubeFile();
    std::string text = builder.gltf();
    text.insert(1, "\"extras\":" + std::string(kDepth, '[') + std::string(kDepth, ']') + ",");
    expectCube(readModel(text));
}

TEST(GltfFile, RefusesOtherVersions) {
    const auto refusal = [](const json& asset) {
        GltfBuilder builder = cubeFile();
        builder.json["asset"] = asset;
        return readModel(builder).refusal;
    };
    EXPECT_EQ(refusal({{"version", "2.1"}}), "");
    EXPECT_EQ(refusal({{"version", "1.0"}}), "asset: version is \"1.0\", must be 2.0; convert the file to glTF 2.0");
    EXPECT_EQ(refusal({{"version", 1.0}}), "asset: version is \"1.0\", must be 2.0; convert the file to glTF 2.0");
    EXPECT_EQ(refusal({{"version", "2.1"}, {"minVersion", "2.1"}}),
              "asset: minVersion is \"2.1\", must be 2.0; convert the file to glTF 2.0");
}

// ---- extensions -----------------------------------------------------------------------------------------------------------

TEST(GltfFile, RefusesRequiredExtensionsByName) {
    GltfBuilder builder = cubeFile();
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit", "ACME_curved_triangles"};
    EXPECT_EQ(readModel(builder).refusal,
              "the file: requires the extension ACME_curved_triangles, which is not read; export it without that");
}

TEST(GltfFile, NotesOptionalExtensionsThatMayChangeTheShape) {
    GltfBuilder builder = cubeFile();
    builder.json["extensionsUsed"] = {"ACME_curved_triangles", "MSFT_lod", "KHR_materials_unlit", "ACME_elsewhere"};
    builder.json["nodes"][0]["extensions"] = {{"MSFT_lod", {{"ids", {1}}}}, {"KHR_lights_punctual", {{"light", 0}}}};
    builder.json["meshes"][0]["primitives"][0]["extensions"] = {{"ACME_curved_triangles", json::object()},
                                                                {"KHR_materials_variants", json::object()}};
    const ReadModel model = readModel(builder);
    expectCube(model);
    EXPECT_EQ(model.notes,
              (std::vector<std::string>{"the extension MSFT_lod is not read; it may change the shape",
                                        "the extension ACME_curved_triangles is not read; it may change the shape"}));
}

// ---- buffers ----------------------------------------------------------------------------------------------------------------

TEST(GltfFile, ReadsDataUris) {
    const GltfBuilder builder = cubeFile();
    expectCube(readModel(builder.gltf("data:;base64," + base64Of(builder.buffer))));
    std::string unpadded = base64Of(builder.buffer);
    while (unpadded.ends_with('='))
        unpadded.pop_back();
    expectCube(readModel(builder.gltf("data:application/gltf-buffer;base64," + unpadded)));
    std::string percent;
    for (const char byte : builder.buffer) {
        std::array<char, 4> text;
        std::snprintf(text.data(), text.size(), "%%%02x", static_cast<uint8_t>(byte));
        percent += text.data();
    }
    expectCube(readModel(builder.gltf("data:application/octet-stream," + percent)));
}

TEST(GltfFile, RefusesBrokenUris) {
    const GltfBuilder builder = cubeFile();
    const auto refusal = [&](const std::string& uri) { return readModel(builder.gltf(uri)).refusal; };
    EXPECT_EQ(refusal("data:nothing"), "buffer 0: its data: URI has no comma; export the file again");
    EXPECT_EQ(refusal("data:;base64,AAA*"), "buffer 0: character 3 of its data is not base64; export the file again");
    EXPECT_EQ(refusal("data:;base64,AAAAA"), "buffer 0: its base64 data is cut short; export the file again");
    EXPECT_EQ(refusal("data:;base64,AAAA"), "buffer 0: byteLength is 168, its data has 3 bytes; copy or export the file again");
    for (const char* uri : {"https://example.com/a.bin", "file:///etc/passwd", "/etc/passwd", "C:\\model.bin"})
        EXPECT_NE(refusal(uri).find("is not relative to the file; put the buffer beside the file"), std::string::npos) << uri;
}

class GltfFolder : public FolderTest {
protected:
    void write(const std::string& name, const std::string& bytes) const {
        std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
        std::ofstream(path(name), std::ios::binary) << bytes;
    }
    // Writes the cube with a buffer of that name and reads it; the URI as given.
    std::string refusal(const std::string& uri, const std::string& buffer_name) const {
        const GltfBuilder builder = cubeFile();
        write("cube.gltf", builder.gltf(uri));
        if (!buffer_name.empty()) write(buffer_name, builder.buffer);
        const auto imported = brittle::importMesh(std::filesystem::path(path("cube.gltf")));
        if (!imported) return imported.error().message;
        EXPECT_EQ(imported->triangles.size(), 12u);
        return "";
    }
};

TEST_F(GltfFolder, BuffersStandBesideTheFile) {
    EXPECT_EQ(refusal("cube.bin", "cube.bin"), "");
    EXPECT_EQ(refusal("parts/cube.bin", "parts/cube.bin"), "");
    EXPECT_EQ(refusal("my%20b%C3%BCffer.bin", "my b\u00fcffer.bin"), "");
    EXPECT_EQ(refusal("my b\u00fcffer.bin", "my b\u00fcffer.bin"), "");
    EXPECT_EQ(refusal("100%.bin", "100%.bin"), "");
    EXPECT_EQ(refusal("a%41.bin", "a%41.bin"), ""); // written without encoding
}

TEST_F(GltfFolder, RefusalsNameTheMissingBuffer) {
    const std::string file = path("cube.gltf") + ": ";
    EXPECT_EQ(refusal("no%20such.bin", ""), file + "buffer 0: its file \"no such.bin\": no such file; put it beside the model");
    EXPECT_EQ(refusal(".", ""), file + "buffer 0: its file \".\": not a file; put it beside the model");
    EXPECT_EQ(refusal("empty.bin%00", ""),
              file + "buffer 0: its uri \"empty.bin%00\" holds a zero byte, which no name of a file has; rename the buffer");
    EXPECT_EQ(refusal("a%1Bb%7F.bin", ""), file + "buffer 0: its file \"a%1Bb%7F.bin\": no such file; put it beside the model");
}

TEST_F(GltfFolder, FromMemoryThereAreNoNeighbors) {
    const auto imported = brittle::importMesh(cubeFile().gltf("cube.bin"), ".gltf");
    ASSERT_FALSE(imported);
    EXPECT_EQ(imported.error().message, "buffer 0: its file \"cube.bin\": it is not in memory; put it beside the model");
}

TEST_F(GltfFolder, NotesCrossFromTheChildProcess) {
    GltfBuilder builder = cubeFile();
    builder.json["nodes"][0]["extensions"] = {{"ACME_a\nb", json::object()}};
    builder.addMesh(builder.json["meshes"][0]["primitives"][0]);
    const auto imported = brittle::importMesh(builder.glb(), ".glb");
    ASSERT_TRUE(imported);
    EXPECT_EQ(imported->notes, (std::vector<std::string>{"1 mesh is left out: no node uses it",
                                                         "the extension ACME_a b is not read; it may change the shape"}));
}

} // namespace
