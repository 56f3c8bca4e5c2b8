#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/import.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/vector_math.h"
#include "tests/support/shared_meshes.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>
#include <unistd.h>

using namespace brittle;

namespace {

using Reader = engine::Result<ImportedMesh> (*)(std::string_view);

std::string errorOf(const engine::Result<ImportedMesh>& mesh) { return mesh ? "" : mesh.error().message; }

// Imported, prepared and checked: empty where the model can be broken.
std::string refusal(const std::filesystem::path& path) {
    const auto imported = importMesh(path);
    if (!imported) return imported.error().message;
    const auto model = prepareMesh(*imported);
    if (!model) return model.error().message;
    const auto report = checkMesh(model->mesh, model->topology);
    return report ? "" : report.error().message;
}

constexpr const char* kTetrahedronObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

class TemporaryFile {
public:
    TemporaryFile(const std::string& ending, const std::string& bytes)
        : path_(std::filesystem::temp_directory_path() / ("brittle_import_test_" + std::to_string(getpid()) + ending)) {
        std::ofstream(path_, std::ios::binary) << bytes;
    }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::string binaryStl(uint32_t promised, uint32_t held, const char* header = "") {
    std::string bytes(80, ' ');
    std::memcpy(bytes.data(), header, std::strlen(header));
    bytes.append(reinterpret_cast<const char*>(&promised), 4);
    for (uint32_t t = 0; t < held; ++t) {
        const std::array<float, 12> numbers = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, static_cast<float>(t + 1), 0};
        bytes.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
        bytes.append(2, '\0');
    }
    return bytes;
}

} // namespace

TEST(ImportObj, IndicesOfEveryKind) {
    const auto mesh = readObj("# c\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nv 0 1 0\r\nvt .25 .75\r\nvn 0 0 2\r\n"
                              "f 1/1/1 2/1 3//1\r\nf -3 -2 \\\r\n -1 # behind\r\nusemtl x\r\nl 1 2\r\n");
    ASSERT_TRUE(mesh) << errorOf(mesh);
    EXPECT_EQ(mesh->triangles, (std::vector<Index3>{{0, 1, 2}, {0, 1, 2}}));
    EXPECT_EQ(mesh->corner_uvs[0], (Float2{.25f, .25f})); // v points down
    EXPECT_EQ(mesh->corner_uvs[2], (Float2{0, 0}));
    EXPECT_EQ(mesh->corner_normals[0], (Float3{0, 0, 2}));
    EXPECT_EQ(mesh->corner_normals[1], (Float3{0, 0, 0}));
}

TEST(ImportObj, KeepsDoubles) {
    const auto mesh = readObj("v 1000000.1234567891 +1e-300 -2.5e6\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->positions[0], (Double3{1000000.1234567891, 1e-300, -2.5e6}));
}

TEST(ImportObj, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(errorOf(readObj("v 0 0 0\nv 1 nan 0\n")).substr(0, 7), "line 2:");
    EXPECT_EQ(errorOf(readObj("v 0 0 0\n\nv 1 1e999 0\n")).substr(0, 7), "line 3:");
    EXPECT_EQ(errorOf(readObj("v 0 0\n")).substr(0, 7), "line 1:");
    EXPECT_EQ(errorOf(readObj("v 0 0 x\n")).substr(0, 7), "line 1:");
    for (const char* face :
         {"f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1 2 a", "f 1/a 2 3", "f 1//a 2 3", "f 1 2 99999999999999999999"})
        EXPECT_EQ(errorOf(readObj(std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\n") + face)).substr(0, 7), "line 4:") << face;
    EXPECT_FALSE(readObj("v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
    EXPECT_FALSE(readObj(""));
    EXPECT_FALSE(readObj("\\"));
    EXPECT_FALSE(readObj(std::string_view("v 0 0 0\0", 8)));
}

TEST(ImportOff, WithPrefixesCommentsAndColors) {
    const auto mesh = readOff("# c\nSTCNOFF 3 1 0 # d\n\n0 0 0  0 0 1  1 0 0 1  .5 .25\n1 0 0  0 0 1  1 0 0 1  .5 .25\n"
                              "0 1 0  0 0 1  1 0 0 1  .5 .25\n3 0 1 2 255 0 0\n");
    ASSERT_TRUE(mesh) << errorOf(mesh);
    EXPECT_EQ(mesh->triangles.size(), 1u);
    EXPECT_EQ(mesh->corner_normals[1], (Float3{0, 0, 1}));
    EXPECT_EQ(mesh->corner_uvs[1], (Float2{.5f, .75f}));
}

TEST(ImportOff, SaysWhatIsWrongAndWhere) {
    const std::string head = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_NE(errorOf(readOff(head)).find("face 1 of 2"), std::string::npos);
    EXPECT_EQ(errorOf(readOff(head + "3 0 1 3\n")).substr(0, 7), "line 7:");
    EXPECT_EQ(errorOf(readOff(head + "3 0 1 -1\n")).substr(0, 7), "line 7:");
    EXPECT_FALSE(readOff(head + "4 0 1"));
    EXPECT_FALSE(readOff("OFF\n4000000000 4000000000 0\n0 0 0\n"));
    EXPECT_FALSE(readOff("OFF\n-1 2 0\n"));
    EXPECT_FALSE(readOff("4OFF\n1 1 1\n"));
    EXPECT_FALSE(readOff("4nOFF\n4\n1 1 1\n"));
    EXPECT_FALSE(readOff("OFF BINARY\n1 1 1\n"));
    EXPECT_FALSE(readOff("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"));
    EXPECT_FALSE(readOff(""));
}

TEST(ImportStl, BinaryAndText) {
    const auto binary = readStl(binaryStl(2, 2, "solid but binary"));
    ASSERT_TRUE(binary) << errorOf(binary);
    EXPECT_EQ(binary->triangles.size(), 2u);
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\nendloop\nendfacet\n";
    const auto text = readStl("solid a name\n" + facet + facet + "endsolid a name\n");
    ASSERT_TRUE(text) << errorOf(text);
    EXPECT_EQ(text->triangles.size(), 2u);
    EXPECT_FALSE(readStl("solid cut short\n" + facet + facet.substr(0, facet.size() / 2)));
    EXPECT_FALSE(readStl("solid x\n" + facet + "facet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid x\n"));
    EXPECT_FALSE(readStl("solid x\nfacet\nvertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid x\n"));
}

TEST(ImportStl, CountsThatLie) {
    for (const auto& [promised, held] : {std::pair{3u, 2u}, {1u, 2u}, {0xfffffffeu, 2u}, {0u, 0u}})
        EXPECT_FALSE(readStl(binaryStl(promised, held))) << promised;
    EXPECT_FALSE(readStl("short"));
}

TEST(ImportPly, TextWithOtherElements) {
    const auto mesh =
        readPly("ply\r\nformat ascii 1.0\r\ncomment c\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\n"
                "property double z\r\nproperty float s\r\nproperty float t\r\nelement edge 1\r\nproperty int a\r\n"
                "property list uchar int b\r\nelement face 1\r\nproperty list uchar uint vertex_index\r\nend_header\r\n"
                "0 0 0 .5 1\r\n1 0 0 0 0\r\n0 1 0 0 0\r\n7 2 1 1\r\n3 0 1 2\r\n");
    ASSERT_TRUE(mesh) << errorOf(mesh);
    EXPECT_EQ(mesh->triangles, (std::vector<Index3>{{0, 1, 2}}));
    EXPECT_EQ(mesh->corner_uvs[0], (Float2{.5f, 0}));
}

TEST(ImportPly, SaysWhatIsWrongAndWhere) {
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_TRUE(readPly(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    EXPECT_NE(errorOf(readPly(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n")).find("face 0 of 1"), std::string::npos);
    EXPECT_NE(errorOf(readPly(head + "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n")).find("vertex 1 of 3"), std::string::npos);
    EXPECT_FALSE(readPly(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"));
    EXPECT_FALSE(readPly(head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"));
    EXPECT_FALSE(readPly(head + "0 0 0\n1 0 0\n0 1 0\n3000000000 0 1 2\n"));
    EXPECT_FALSE(readPly("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n0\n"));
    EXPECT_FALSE(readPly("ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n"));
    EXPECT_FALSE(readPly("ply\nformat odd 1.0\nend_header\n"));
    EXPECT_FALSE(readPly("ply\nproperty float x\nend_header\n"));
    EXPECT_FALSE(readPly("ply\n"));
    EXPECT_FALSE(readPly(""));
}

TEST(Import, FilesThatAreNone) {
    EXPECT_NE(errorOf(importMesh("/nowhere/model.obj")).find("/nowhere/model.obj"), std::string::npos);
    EXPECT_FALSE(importMesh("/"));
    EXPECT_FALSE(importMesh(""));
    EXPECT_FALSE(importMesh(std::string(100'000, 'x') + ".obj"));
    const TemporaryFile unknown(".xyz", kTetrahedronObj), upper(".OBJ", kTetrahedronObj), empty(".glb", "");
    EXPECT_FALSE(importMesh(unknown.path()));
    EXPECT_TRUE(importMesh(upper.path()));
    EXPECT_FALSE(importMesh(empty.path()));
}

// A glTF file whose node lies far away and is mirrored: its transform counts, in double, and turns the triangles.
TEST(Import, TransformsOfNodesApply) {
    const TemporaryFile file(".gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"translation":[1000000,0,0],"children":[1]},{"mesh":0,"scale":[-1,1,1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                     {"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
        "buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAIBAAEDAQIDAAMC"}]})");
    const auto imported = importMesh(file.path());
    ASSERT_TRUE(imported) << errorOf(imported);
    const auto model = prepareMesh(*imported);
    ASSERT_TRUE(model);
    EXPECT_FALSE(model->notes.turned_inside_out);
    EXPECT_EQ(model->mesh.center, (Double3{999999.5, 0.5, 0.5}));
    EXPECT_TRUE(checkMesh(model->mesh, model->topology));
}

// Files spoiled at random: refused or read, never more.
TEST(Import, SpoiledFilesDoNoHarm) {
    const std::array<std::pair<Reader, std::string>, 5> sources = {{
        {readObj, std::string(kTetrahedronObj) + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"},
        {readOff, "NOFF\n4 4 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"},
        {readPly,
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {readPly,
         std::string(
             "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\nproperty char z\n"
             "element face 1\nproperty list uchar uchar vertex_index\nend_header\n\1\2\3\3\0\0\0",
             164)},
        {readStl, binaryStl(3, 3)},
    }};
    std::mt19937 random(11);
    uint32_t read = 0;
    for (int round = 0; round < 4000; ++round) {
        const auto& [reader, source] = sources[random() % sources.size()];
        std::string bytes = source;
        for (uint32_t change = random() % 4; change-- > 0 && !bytes.empty();) {
            const size_t at = random() % bytes.size();
            switch (random() % 4) {
            case 0: bytes[at] = static_cast<char>(random()); break;
            case 1: bytes.erase(at, random() % 8); break;
            case 2: bytes.resize(at); break;
            default: bytes.insert(at, 1, "0123456789-./e \n\\"[random() % 17]);
            }
        }
        const auto mesh = reader(bytes);
        if (!mesh) continue;
        ++read;
        if (const auto model = prepareMesh(*mesh)) inspectMesh(model->mesh, model->topology);
    }
    EXPECT_GT(read, 500u);
}

TEST(Import, EveryFormatReadsASharedModel) {
    SKIP_WITHOUT_MESHES();
    for (const char* name :
         {"ico4.obj", "fandisk.off", "seaVase.ply", "gearwheel.bin.stl", "WaterBottle.glb", "spider.fbx", "abdomen.dae"})
        EXPECT_EQ(errorOf(importMesh(support::sharedMesh(name))), "") << name;
    EXPECT_EQ(refusal(support::sharedMesh("Box-cr-line-ends.ply")), "");
    EXPECT_EQ(refusal(support::sharedMesh("abdomen.dae")), "");
}

TEST(Import, BrokenSharedModels) {
    SKIP_WITHOUT_MESHES();
    struct Expected {
        const char* name;
        const char* words; // of the refusal; empty if the file is read
    };
    static constexpr Expected kModels[] = {
        {"fandisk-truncated.off", "face 4593 of 12946"},
        {"gearwheel-truncated.stl", "promises 2444 triangles"},
        {"gearwheel-count-huge.stl", ""}, // a count of -1 says that the program did not know it
        {"gearwheel-solid-header.stl", ""},
        {"spot-nan.obj", "line 10: a coordinate is not a finite number"},
        {"torus-index-out-of-range.obj", "line 2358: a face refers to a vertex that is not there"},
        {"bones-face-count-too-big.off", "face 4204 of 4704"},
        {"WaterBottle-truncated.glb", "promises 109484 bytes, the file has 54742"},
        {"abdomen-truncated.dae", "line 2755: float_array has 28129 numbers, its count is 48456"},
        {"spider-truncated.fbx", "cannot be read"},
        {"empty.obj", "empty"},
        {"vertices-only.obj", "829 vertices but no faces"},
        {"header-only.ply", "vertex 0 of 99519"},
        {"huge-count.ply", "of 4000000000"},
        {"random-bytes.stl", "promises"},
        {"stl-named.obj", "binary data"},
        {"spot-bigendian-double.ply", ""},
        {"torus-double-sided.obj", "4608 doubled triangles"},
        {"spot-30pct-flipped.obj", "turns over"},
        {"spot-t-junctions.obj", "180 open edges"},
        {"torus-collinear-triangles.obj", ""},
        {"gearwheel-jitter-1e-6.stl", "7332 open edges"},
        {"torus-scale-1e-6.obj", ""},
        {"trefoil-scale-1e7.obj", ""},
        {"couplingdown-offset-1e6.off", ""},
        {"gearwheel-offset-1e5-float32.stl", ""}, // closed; what folds over there lies flat in its plane
        {"hollow-ico4-wall-2pct.obj", ""},
        {"one-triangle.stl", "3 open edges"},
        {"torus-stray-vertices.obj", ""},
        {"ico4-flattened.obj", "doubled triangles"},
        {"l-prism-concave-ngons.obj", ""},
    };
    for (const Expected& expected : kModels) {
        const std::string message = refusal(support::sharedMesh("bad/" + std::string(expected.name)));
        EXPECT_EQ(message.empty(), *expected.words == '\0') << expected.name << ": " << message;
        EXPECT_NE(message.find(expected.words), std::string::npos) << expected.name << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << expected.name;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(support::sharedMesh("bad")), {}) - 1,
              static_cast<std::ptrdiff_t>(std::size(kModels))); // the one more is README.md
}

TEST(Import, MeasuresOfSharedModels) {
    SKIP_WITHOUT_MESHES();
    struct Expected {
        const char* name;
        double volume, area; // by the catalogue
    };
    static constexpr Expected kModels[] = {
        {"ico4.obj", 4.152684883158709, 12.50617583},
        {"cheese.off", 0.0004411847203806272, 0.1334932544},
        {"utah_teapot.stl", 526.5074025890339, 388.6062594},
        {"bad/couplingdown-offset-1e6.off", 0.19065983626979466, 3.566696413},
        {"bad/torus-scale-1e-6.obj", 1.218784495415975e-18, 9.837048739e-12},
        {"bad/trefoil-scale-1e7.obj", 2.222512621181258e+22, 9012066887000000.0},
        {"bad/hollow-ico4-wall-2pct.obj", 0.24421109260879761, 24.5171071},
        {"bad/l-prism-concave-ngons.obj", 3, 14},
        {"ellipe0.003.off", 1.4740223021516563, 6.673491334},
        {"Box-cr-line-ends.ply", 1922.9937880231228, 928.1228951},
    };
    for (const Expected& expected : kModels) {
        const auto imported = importMesh(support::sharedMesh(expected.name));
        ASSERT_TRUE(imported) << expected.name;
        const auto model = prepareMesh(*imported);
        ASSERT_TRUE(model) << expected.name;
        const MeshReport report = inspectMesh(model->mesh, model->topology);
        EXPECT_NEAR(report.measures.volume, expected.volume, 2e-7 * expected.volume) << expected.name;
        EXPECT_NEAR(report.measures.area, expected.area, 2e-7 * expected.area) << expected.name;
    }
}
