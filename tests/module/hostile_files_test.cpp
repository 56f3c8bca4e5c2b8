// Files that mean harm, or met some: refused in one line that says why, or read as what they are; with little memory either
// way.
#include "modules/brittle/export/model_file.h"
#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/mesh/repair/repair.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/vector_math.h"

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <ostream>
#include <sys/stat.h>
#include <unistd.h>

using namespace brittle;

namespace {

struct Hostile {
    const char* name;
    const char* ending;
    std::string bytes;
    const char* refusal; // what it says; "" where the model is sound
};

void PrintTo(const Hostile& file, std::ostream* out) { *out << file.name; }

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string kFaces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

std::string tetrahedron(const std::string& third) { return "v 0 0 0\nv 1 0 0\nv 0 " + third + " 0\nv 0 0 1\n" + kFaces; }

std::string ply(const std::string& vertices, const std::string& faces, const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

std::string withLineEnds(const std::string& text, const std::string& end) {
    std::string result;
    for (const char c : text)
        result += c == '\n' ? end : std::string(1, c);
    return result;
}

std::string stl(uint32_t count, const std::vector<std::array<float, 9>>& triangles) {
    std::string bytes(80, 's');
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    for (const std::array<float, 9>& t : triangles) {
        bytes.append(12, '\0');
        bytes.append(reinterpret_cast<const char*>(t.data()), sizeof t);
        bytes.append(2, '\0');
    }
    return bytes;
}

// A polygon of that many corners that goes there and back again, one step up each time.
std::string zigzag(uint32_t corners) {
    std::string text, face = "f";
    for (uint32_t k = 0; k < corners; ++k) {
        text += "v " + std::to_string(k % 2 * 100) + " " + std::to_string(k) + " 0\n";
        face += " " + std::to_string(k + 1);
    }
    return text + face + "\n";
}

std::vector<Hostile> hostileFiles() {
    const float nan = std::nanf(""), far = 3e38f;
    const std::string gltf_head = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)";
    const std::string gltf_mesh = R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,
        "componentType":5126,"count":4000000000,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":12}],"buffers":[{"byteLength":
        12,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})";
    return {
        // Numbers.
        {"Nan", ".obj", tetrahedron("nan"), "line 3: a coordinate is not a finite number"},
        {"Infinity", ".obj", tetrahedron("-inf"), "line 3: a coordinate is not a finite number"},
        {"TooLargeForADouble", ".obj", tetrahedron("1e309"), "line 3: a coordinate is not a finite number"},
        {"AsLargeAsADouble", ".obj", tetrahedron("1e308"), "inf units large"},
        {"BothEndsOfDouble", ".obj", "v -1e308 0 0\nv 1e308 0 0\nv 0 1e308 0\nv 0 0 1e308\n" + kFaces, "inf units large"},
        {"TooSmallForADouble", ".obj", tetrahedron("1e-999"), "doubled"},
        {"HexadecimalAndNamed", ".obj", tetrahedron("0x10"), "line 3: a vertex needs three numbers"},
        {"NanInOff", ".off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 4: a coordinate is not a finite number"},
        {"NanInPly", ".ply", ply("3", "1", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "vertex 1 of 3: a coordinate is not a finite"},
        {"NanInStl", ".stl", stl(1, {{0, 0, 0, 1, nan, 0, 0, 1, 0}}), "triangle 0 (byte 84): a coordinate is not a finite"},
        {"FarFloatsInStl", ".stl", stl(1, {{-far, 0, 0, far, 0, 0, 0, far, 0}}), "units large"},
        {"NoSize", ".obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n", "collapsed to a line or point"},
        {"AllInOneLine", ".obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 3 2\n", "doubled"},
        // Counts.
        {"CountsOfOff", ".off", "OFF\n18446744073709551615 18446744073709551615 0\n0 0 0\n",
         "vertex 1 of 18446744073709551615"},
        {"CornersOfOff", ".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", "ends at face 0 of 1"},
        {"CountsOfPly", ".ply", ply("18446744073709551615", "1", "0 0 0\n"), "vertex 1 of 18446744073709551615"},
        {"ListOfPly", ".ply", ply("3", "1", "0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n"), "a list that is longer than the file"},
        {"NegativeListOfPly", ".ply", ply("3", "1", "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), "a list that is longer than the file"},
        {"NothingAtAllMany", ".ply", "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n", "no faces"},
        {"CountOfStl", ".stl", stl(0xfffffffe, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}), "promises 4294967294 triangles"},
        {"NoCountOfStl", ".stl", stl(0xffffffff, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}), "open edges"},
        {"NoTrianglesInStl", ".stl", stl(0, {}), "no triangles"},
        {"AccessorOfGltf", ".gltf", gltf_head + gltf_mesh, "accessor 0: 4000000000 elements reach beyond its buffer view"},
        {"MatrixOfNans", ".gltf", gltf_head + R"(,"scale":[1e999,0,0])" + gltf_mesh, "a number is too large"},
        // Indices.
        {"BeyondTheLast", ".obj", kCorners + "f 1 2 5\n", "line 5: a face refers to a vertex that is not there"},
        {"BeforeTheFirst", ".obj", kCorners + "f -5 1 2\n", "line 5: a face refers to a vertex that is not there"},
        {"Zero", ".obj", kCorners + "f 0 1 2\n", "line 5: a face refers to a vertex that is not there"},
        {"LeastInteger", ".obj", kCorners + "f -9223372036854775808 1 2\n", "line 5: a face refers to a vertex"},
        {"BeyondInPly", ".ply", ply("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "face 0 of 1: it refers to a vertex"},
        {"FractionInPly", ".ply", ply("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n"), "face 0 of 1: it refers to a vertex"},
        // Faces.
        {"MixedFaces", ".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n",
         ""},
        {"TwoCorners", ".obj", kCorners + kFaces + "f 1 2\n", ""},
        {"OneCornerThrice", ".obj", kCorners + kFaces + "f 1 1 1\n", ""},
        {"CornerTwice", ".obj", kCorners + "f 1 3 2 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", ""},
        {"TooManyCorners", ".obj", zigzag(10'001), "more than 10,000 corners"},
        {"ThereAndBackAgain", ".obj", zigzag(3'999), "crosses itself|open edges"},
        {"BowTie", ".obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "open edges|crosses itself|doubled"},
        // Lines and what they are made of.
        {"CarriageReturns", ".obj", withLineEnds(kCorners + kFaces, "\r\n"), ""},
        {"OldCarriageReturns", ".obj", withLineEnds(kCorners + kFaces, "\r"), ""},
        {"NoLastLineEnd", ".obj", (kCorners + kFaces).substr(0, kCorners.size() + kFaces.size() - 1), ""},
        {"ByteOrderMark", ".obj", "\xEF\xBB\xBF" + kCorners + kFaces, ""},
        {"ByteOrderMarkInOff", ".off",
         "\xEF\xBB\xBFOFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n", ""},
        {"SixteenBitText", ".obj", std::string("\xFF\xFEv\0 \0", 6), "saved as UTF-16; save it as ASCII or UTF-8"},
        {"OneVeryLongLine", ".obj", std::string(1'000'000, 'x'), "no vertices"},
        {"ManyContinuations", ".obj", std::string(100'000, '\\'), "no vertices"},
        {"OnlyBlanks", ".off", "   \n\n\t\n", "begins with the word OFF"},
        // Other formats.
        {"NoFormat", ".glb", "glTF", "the GLB header: is cut short"},
        {"NotJson", ".gltf", "{{{{{{{{", "the JSON: cannot be read at byte 2"},
        {"DeepJson", ".gltf", std::string(200'000, '['), "the JSON: cannot be read at byte 200001"},
        {"NotXml", ".dae", "<COLLADA><<<", "cannot be read|the reader failed"},
        {"DeepXml", ".dae",
         []() {
             std::string text = "<COLLADA>";
             for (int k = 0; k < 100'000; ++k)
                 text += "<node>";
             return text;
         }(),
         "cannot be read|the reader failed"},
        {"NotFbx", ".fbx", std::string("Kaydara FBX Binary  \0\x1a\0\xff\xff\xff\xff\xff\xff\xff\xff", 31),
         "cannot be read|the reader failed"},
        {"Zeros", ".stl", std::string(10'000, '\0'), "promises 0 triangles"},
    };
}

// One of the ways in which `words`, parted by bars, put it.
bool saysOneOf(const std::string& message, std::string words) {
    for (words += '|'; !words.empty(); words.erase(0, words.find('|') + 1))
        if (message.find(words.substr(0, words.find('|'))) != message.npos) return true;
    return false;
}

// What comes of the model on its way to being broken: empty where it is sound.
std::string refusalOf(const engine::Result<ImportedMesh>& imported) {
    if (!imported) return imported.error().message;
    const auto model = prepareMesh(*imported);
    if (!model) return model.error().message;
    const auto report = checkMesh(model->mesh, model->topology);
    return report ? "" : report.error().message;
}

// The same with mending, which may only end in a sound model.
std::string refusalWithRepairOf(const engine::Result<ImportedMesh>& imported) {
    if (!imported) return imported.error().message;
    const auto repaired = repairMesh(*imported);
    if (!repaired) return repaired.error().message;
    return checkMesh(repaired->model.mesh, repaired->model.topology) ? "" : "not mended";
}

class HostileFile : public testing::TestWithParam<Hostile> {};

// In a process with little memory to spare: counts that lie must not be believed.
TEST_P(HostileFile, IsRefusedOrReadForWhatItIs) {
    const Hostile& file = GetParam();
    const auto outcome = engine::runIsolated(
        [&] {
            const auto imported = importMesh(file.bytes, file.ending);
            return refusalOf(imported) + "\n" + refusalWithRepairOf(imported);
        },
        {.seconds = 60, .bytes = uint64_t{1500} << 20});
    ASSERT_TRUE(outcome.isDone()) << static_cast<int>(outcome.end);
    const std::string& said = outcome.answer;
    const std::string refusal = said.substr(0, said.find('\n')), repaired = said.substr(refusal.size() + 1);
    EXPECT_EQ(repaired.find('\n'), std::string::npos) << said;
    EXPECT_NE(repaired, "not mended");
    EXPECT_EQ(refusal.empty(), *file.refusal == '\0') << refusal;
    EXPECT_TRUE(saysOneOf(refusal, file.refusal)) << refusal;
}

INSTANTIATE_TEST_SUITE_P(Import, HostileFile, testing::ValuesIn(hostileFiles()),
                         [](const testing::TestParamInfo<Hostile>& parameter) { return std::string(parameter.param.name); });

// ---- files cut short ------------------------------------------------------------------------------------------------------

Mesh sphere() { return prepareMesh(makeIcosphere(0))->mesh; }

std::string exported(const char* format) {
    const std::string obj = *encodeModel(sphere(), ".obj");
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(obj.data(), obj.size(), 0, "obj");
    Assimp::Exporter exporter;
    const aiExportDataBlob* blob = exporter.ExportToBlob(scene, format);
    return {static_cast<const char*>(blob->data), blob->size};
}

std::string binaryStl() {
    const Mesh mesh = sphere();
    std::vector<std::array<float, 9>> triangles;
    for (const Index3& t : mesh.triangles) {
        std::array<float, 9> corners;
        for (size_t k = 0; k < 9; ++k)
            corners[k] = mesh.positions[t[k / 3]][k % 3];
        triangles.push_back(corners);
    }
    return stl(static_cast<uint32_t>(triangles.size()), triangles);
}

// A text that ends within its last number cannot be told from a whole one, but by what it says: the model is not sound then.
void expectNoHarm(const std::string& bytes, const char* ending, size_t step) {
    const double whole = checkMesh(sphere(), buildTopology(sphere()))->measures.volume;
    ASSERT_EQ(refusalOf(importMesh(bytes, ending)), "") << ending;
    for (size_t size = 0; size < bytes.size(); size += step) {
        const auto imported = importMesh(std::string_view(bytes).substr(0, size), ending);
        const std::string refusal = refusalOf(imported);
        EXPECT_EQ(refusal.find('\n'), std::string::npos);
        EXPECT_NE(refusalWithRepairOf(imported), "not mended");
        if (!refusal.empty()) continue;
        const auto model = prepareMesh(*imported);
        EXPECT_NEAR(checkMesh(model->mesh, model->topology)->measures.volume, whole, 1e-3 * whole) << ending << " at " << size;
    }
}

TEST(CutShort, FilesOfOurOwnReadersAtEveryByte) {
    expectNoHarm(*encodeModel(sphere(), ".obj"), ".obj", 1);
    expectNoHarm(*encodeModel(sphere(), ".off"), ".off", 1);
    expectNoHarm(*encodeModel(sphere(), ".ply"), ".ply", 1);
    expectNoHarm(binaryStl(), ".stl", 1);
    expectNoHarm(exported("stl"), ".stl", 1);
    expectNoHarm(exported("plyb"), ".ply", 1);
}

TEST(CutShort, FilesOfOtherReaders) {
    expectNoHarm(exported("glb2"), ".glb", 37);
    expectNoHarm(exported("collada"), ".dae", 149);
    expectNoHarm(exported("fbxa"), ".fbx", 197);
}

// ---- what is no file, or not to be had -------------------------------------------------------------------------------------

class OddPaths : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string refusal(const std::string& name) const {
        const auto imported = importMesh(folder_ / name);
        EXPECT_FALSE(imported);
        return imported ? "" : imported.error().message;
    }
    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / ("brittle_odd_paths_" + std::to_string(getpid()));
};

TEST_F(OddPaths, AreRefused) {
    std::filesystem::create_directories(folder_ / "folder.obj");
    EXPECT_TRUE(refusal("folder.obj").ends_with("folder.obj: not a file"));
    ASSERT_EQ(mkfifo((folder_ / "pipe.stl").c_str(), 0600), 0);
    EXPECT_TRUE(refusal("pipe.stl").ends_with("pipe.stl: not a file"));
    std::filesystem::create_symlink("nowhere.obj", folder_ / "link.obj");
    EXPECT_TRUE(refusal("link.obj").ends_with("link.obj: no such file"));
    EXPECT_TRUE(refusal("missing.obj").ends_with("missing.obj: no such file"));
    std::ofstream(folder_ / "model.xyz") << kCorners << kFaces;
    EXPECT_NE(refusal("model.xyz").find("a format that is not read"), std::string::npos);
    std::ofstream(folder_ / "model") << kCorners << kFaces;
    EXPECT_NE(refusal("model").find("a format that is not read"), std::string::npos);
}

// Root may read everything, so it is no longer root that reads.
TEST_F(OddPaths, AFileThatMayNotBeReadIsRefused) {
    std::ofstream(folder_ / "secret.obj") << kCorners << kFaces;
    std::filesystem::permissions(folder_ / "secret.obj", std::filesystem::perms::none);
    const auto said = engine::runIsolated([&] {
        constexpr uid_t kNobody = 65534;
        return geteuid() != 0 || seteuid(kNobody) == 0 ? refusal("secret.obj") : std::string("still root");
    });
    ASSERT_TRUE(said.isDone());
    EXPECT_NE(said.answer.find("secret.obj: cannot be read; check its permissions"), std::string::npos) << said.answer;
}

// ---- models written back ----------------------------------------------------------------------------------------------------

TEST(ModelFile, IsReadBackAsTheSameMesh) {
    ImportedMesh far = makeBumpySphere(2);
    for (Double3& p : far.positions)
        p = p + Double3{1e6, -2e6, 3e6};
    const auto model = prepareMesh(far);
    for (const char* ending : {".obj", ".OFF", ".ply"}) {
        const auto bytes = encodeModel(model->mesh, ending);
        ASSERT_TRUE(bytes);
        const auto again = prepareMesh(*importMesh(*bytes, ending));
        ASSERT_TRUE(again);
        EXPECT_EQ(again->mesh.center, model->mesh.center);
        EXPECT_EQ(again->mesh.positions, model->mesh.positions);
        EXPECT_EQ(again->mesh.triangles, model->mesh.triangles);
        EXPECT_EQ(refusalOf(importMesh(*bytes, ending)), "");
    }
    EXPECT_FALSE(encodeModel(model->mesh, ".stl"));
    EXPECT_FALSE(encodeModel(model->mesh, ""));
}

TEST(ModelFile, KeepsNormalsAndTextureCoordinatesInObj) {
    auto model = prepareMesh(makeCube());
    for (size_t corner = 0; corner < model->mesh.corner_uvs.size(); ++corner)
        model->mesh.corner_uvs[corner] = {static_cast<float>(corner) / 64, 0.25f};
    const auto again = importMesh(*encodeModel(model->mesh, ".obj"), ".obj");
    ASSERT_TRUE(again);
    EXPECT_EQ(again->corner_uvs, model->mesh.corner_uvs);
    EXPECT_EQ(again->corner_normals, model->mesh.corner_normals);
}

} // namespace
