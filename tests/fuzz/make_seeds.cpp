// make_seeds FOLDER: writes FOLDER/obj, off, ply, stl, gltf, glb, gltf_reader, fbx and dae with small models for the fuzzers to
// start from, sound and spoiled in the ways that mending is about, and FOLDER/toml with small scenes.
#include "modules/brittle/export/model_file.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/primitives.h"
#include "modules/brittle/scene/library/builtin_scenes.h"
#include "modules/brittle/scene/scene_file.h"
#include "tests/support/gltf_builder.h"
#include "tests/support/solids.h"

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

using namespace brittle;
using namespace support;

namespace {

namespace fs = std::filesystem;

// Those triangles alone.
ImportedMesh part(ImportedMesh mesh, size_t first, size_t count) {
    const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(first);
    mesh.triangles = std::vector<Index3>(begin, begin + static_cast<std::ptrdiff_t>(count));
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    return mesh;
}

// A corner in the middle of an edge, on one side only.
ImportedMesh withJunction(ImportedMesh mesh) {
    const Index3 t = mesh.triangles.back();
    const Double3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]];
    mesh.positions.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    const auto middle = static_cast<uint32_t>(mesh.positions.size() - 1);
    mesh.triangles.back() = {t[0], middle, t[2]};
    mesh.triangles.push_back({middle, t[1], t[2]});
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    return mesh;
}

// A triangle without area that reaches far beyond the model.
ImportedMesh withSpike(ImportedMesh mesh) {
    mesh.positions.push_back({1e6, 0, 0});
    mesh.triangles.push_back({0, 0, static_cast<uint32_t>(mesh.positions.size() - 1)});
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    return mesh;
}

std::map<std::string, ImportedMesh> models() {
    const ImportedMesh cube = makeCube(), ball = makeIcosphere(0);
    ImportedMesh flipped = cube;
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    return {{"cube", cube},
            {"ball", ball},
            {"open", part(cube, 0, 10)},
            {"flipped", flipped},
            {"doubled", cube + turnedOver(cube)},
            {"hollow", cube + moved(ball, 0.2, {0, 0, 0})},
            {"touching", cube + moved(cube, 1, {1, 0, 0})},
            {"seam", part(ball, 0, 10) + moved(part(ball, 10, 10), 1, {0, 0, 1e-6})},
            {"junction", withJunction(ball)},
            {"spike", withSpike(part(cube, 0, 10))}};
}

void write(const fs::path& path, const std::string& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

// As the file has it: nothing mended, nothing turned.
Mesh asMesh(const ImportedMesh& imported) {
    Mesh mesh;
    for (const Double3& p : imported.positions)
        mesh.positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    mesh.triangles = imported.triangles;
    mesh.corner_normals.assign(3 * mesh.triangles.size(), {0, 0, 1});
    mesh.corner_uvs.assign(3 * mesh.triangles.size(), {0, 0});
    return mesh;
}

std::string stlOf(const Mesh& mesh) {
    std::string bytes(80, ' ');
    const auto add = [&](const void* data, size_t size) { bytes.append(static_cast<const char*>(data), size); };
    const auto count = static_cast<uint32_t>(mesh.triangles.size());
    add(&count, 4);
    for (const Index3& t : mesh.triangles) {
        bytes.append(12, '\0');
        for (const uint32_t v : t)
            add(mesh.positions[v].data(), sizeof(Float3));
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string stlTextOf(const Mesh& mesh) {
    std::string text = "solid s\n";
    for (const Index3& t : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const uint32_t v : t) {
            text += "vertex";
            for (const float x : mesh.positions[v])
                text += " " + std::to_string(x);
            text += "\n";
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid s\n";
}

// Binary, the other way round than this machine has it.
std::string bigEndianPlyOf(const Mesh& mesh) {
    std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                        std::to_string(mesh.triangles.size()) + "\nproperty list uchar ushort vertex_indices\nend_header\n";
    const auto add = [&](const auto& value) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        bytes.append(raw.rbegin(), raw.rend());
    };
    for (const Float3& p : mesh.positions)
        for (const float x : p)
            add(x);
    for (const Index3& t : mesh.triangles) {
        bytes += '\3';
        for (const uint32_t v : t)
            add(static_cast<uint16_t>(v));
    }
    return bytes;
}

std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The buffer becomes a part of the file: read from memory it has no neighbors.
void embedBuffer(const fs::path& gltf) {
    const fs::path buffer = fs::path(gltf).replace_extension(".bin");
    std::string text = read(gltf);
    if (const size_t at = text.find(buffer.filename().string()); at != text.npos)
        text.replace(at, buffer.filename().string().size(), "data:application/octet-stream;base64," + base64Of(read(buffer)));
    fs::remove(buffer);
    write(gltf, text);
}

// Each by assimp's exporter, from the OBJ file.
void writeOthers(const fs::path& folder, const fs::path& obj) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(obj.string(), 0);
    if (!scene) return;
    const std::pair<const char*, const char*> formats[] = {
        {"glb2", "glb"}, {"gltf2", "gltf"}, {"fbx", "fbx"}, {"fbxa", "fbx"}, {"collada", "dae"}};
    for (const auto& [id, ending] : formats) {
        const fs::path path = folder / ending / (obj.stem().string() + "_" + id + "." + ending);
        fs::create_directories(path.parent_path());
        Assimp::Exporter().Export(scene, id, path.string());
        if (path.extension() == ".gltf") embedBuffer(path);
    }
}

void writeGltf(const fs::path& folder, const std::string& name, const GltfBuilder& builder) {
    for (const char* reader : {"gltf_reader", "glb"})
        write(folder / reader / (name + ".glb"), builder.glb());
    for (const char* reader : {"gltf_reader", "gltf"})
        write(folder / reader / (name + ".gltf"), builder.gltf());
}

void writeScenes(const fs::path& folder) {
    for (const SceneEntry& entry : builtinScenes())
        if (const std::string text = writeScene(*makeBuiltinScene(entry.name)); text.size() < 4096)
            write(folder / (entry.name + ".toml"), text);
    for (const RefusedScene& refused : refusedScenes())
        write(folder / (refused.scene.name + ".toml"), writeScene(refused.scene));
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_seeds FOLDER\n");
        return 2;
    }
    const fs::path folder = argv[1];
    for (const auto& [name, imported] : models()) {
        const Mesh mesh = asMesh(imported);
        for (const char* ending : {"obj", "off", "ply"})
            write(folder / ending / (name + "." + ending), *encodeModel(mesh, std::string(".") + ending));
        write(folder / "ply" / (name + "_binary.ply"), bigEndianPlyOf(mesh));
        write(folder / "stl" / (name + ".stl"), stlOf(mesh));
        write(folder / "stl" / (name + "_text.stl"), stlTextOf(mesh));
        writeOthers(folder, folder / "obj" / (name + ".obj"));
    }
    writeGltf(folder, "rich", richGltf());
    writeGltf(folder, "cube_alone", cubeFile());
    writeScenes(folder / "toml");
    return 0;
}
