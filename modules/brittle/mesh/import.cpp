#include "modules/brittle/mesh/import.h"

#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/vector_math.h"

#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <algorithm>
#include <cstring>
#include <fstream>

namespace brittle {
namespace {

constexpr uintmax_t kMaxFileBytes = uintmax_t{4} << 30;

std::string lowerCase(std::string ending) {
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

engine::Result<uintmax_t> fileSize(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return badInput("no such file");
    if (!std::filesystem::is_regular_file(path, error)) return badInput("not a file");
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return badInput("cannot be opened: " + error.message());
    if (size == 0) return badInput("the file is empty");
    if (size > kMaxFileBytes) return badInput("larger than 4 GiB");
    return size;
}

engine::Result<std::string> readBytes(const std::filesystem::path& path, uintmax_t size) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes(size, '\0');
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) return badInput("cannot be read; check its permissions");
    return bytes;
}

// ---- assimp ---------------------------------------------------------------------------------------------------------------
// Debian's build of it has no handler to install for its assertions. The child hands the finished mesh over as bytes.

// Row-major, in double: a model may lie far from the origin by its node's translation alone.
struct Transform {
    std::array<Double3, 3> rows = {Double3{1, 0, 0}, Double3{0, 1, 0}, Double3{0, 0, 1}};
    Double3 offset = {0, 0, 0};

    Double3 turned(const Double3& p) const { return {dot(rows[0], p), dot(rows[1], p), dot(rows[2], p)}; }
    Double3 column(size_t c) const { return {rows[0][c], rows[1][c], rows[2][c]}; }
    double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
    // By the cofactors, so that normals stay upright under uneven scale.
    Double3 turnedNormal(const Double3& n) const {
        const double sign = determinant() < 0 ? -1 : 1;
        const std::array<Double3, 3> cofactors = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
        return sign * Double3{dot(cofactors[0], n), dot(cofactors[1], n), dot(cofactors[2], n)};
    }
};

Transform toTransform(const aiMatrix4x4& m) {
    const auto row = [&](unsigned r) {
        return Double3{static_cast<double>(m[r][0]), static_cast<double>(m[r][1]), static_cast<double>(m[r][2])};
    };
    return {{row(0), row(1), row(2)},
            {static_cast<double>(m[0][3]), static_cast<double>(m[1][3]), static_cast<double>(m[2][3])}};
}

Transform operator*(const Transform& a, const Transform& b) {
    Transform product;
    for (size_t r = 0; r < 3; ++r)
        product.rows[r] = {dot(a.rows[r], b.column(0)), dot(a.rows[r], b.column(1)), dot(a.rows[r], b.column(2))};
    product.offset = a.turned(b.offset) + a.offset;
    return product;
}

Double3 toDouble(const aiVector3D& v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

class SceneFlattener {
public:
    engine::Result<ImportedMesh> run(const aiScene& scene);

private:
    const char* addMesh(const aiMesh& mesh, const Transform& transform);
    PolygonCorner corner(const aiMesh& mesh, uint32_t index, const Transform& transform) const;

    MeshBuilder mesh_;
    uint32_t first_vertex_ = 0;
    std::vector<PolygonCorner> corners_;
};

engine::Result<ImportedMesh> SceneFlattener::run(const aiScene& scene) {
    if (!scene.mRootNode) return badInput("no scene in it; export the model again");
    std::vector<std::pair<const aiNode*, Transform>> waiting = {
        {scene.mRootNode, toTransform(scene.mRootNode->mTransformation)}};
    while (!waiting.empty()) {
        const auto [node, transform] = waiting.back();
        waiting.pop_back();
        for (unsigned m = 0; m < node->mNumMeshes; ++m) {
            if (node->mMeshes[m] >= scene.mNumMeshes) return badInput("a node refers to a mesh that is not there");
            if (const char* wrong = addMesh(*scene.mMeshes[node->mMeshes[m]], transform))
                return badInput("mesh " + std::to_string(node->mMeshes[m]) + ": " + wrong);
        }
        for (unsigned c = node->mNumChildren; c-- > 0;)
            waiting.emplace_back(node->mChildren[c], transform * toTransform(node->mChildren[c]->mTransformation));
    }
    if (mesh_.triangleCount() == 0) return badInput("no triangles in it; export the model with its meshes");
    return mesh_.take();
}

const char* SceneFlattener::addMesh(const aiMesh& mesh, const Transform& transform) {
    first_vertex_ = static_cast<uint32_t>(mesh_.vertexCount());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const Double3 position = transform.turned(toDouble(mesh.mVertices[v])) + transform.offset;
        if (!isFinite(position)) return kNotFinite;
        mesh_.addVertex(position);
    }
    const bool is_mirrored = transform.determinant() < 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        corners_.clear();
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices) return "a face refers to a vertex that is not there";
            corners_.push_back(corner(mesh, face.mIndices[k], transform));
        }
        if (is_mirrored) std::reverse(corners_.begin(), corners_.end());
        if (const char* wrong = mesh_.addPolygon(corners_)) return wrong;
    }
    return nullptr;
}

PolygonCorner SceneFlattener::corner(const aiMesh& mesh, uint32_t index, const Transform& transform) const {
    PolygonCorner corner;
    corner.position = first_vertex_ + index;
    if (mesh.mNormals) corner.normal = toFloat(normalized(transform.turnedNormal(toDouble(mesh.mNormals[index])), {0, 0, 0}));
    if (mesh.mTextureCoords[0]) corner.uv = {mesh.mTextureCoords[0][index].x, 1 - mesh.mTextureCoords[0][index].y};
    return corner;
}

// Libraries' messages may run over lines and pages.
std::string oneLine(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
    if (text.size() > 200) text = text.substr(0, 200) + "...";
    return text;
}

// No post-processing: its triangulation, for one, asserts on damaged faces.
engine::Result<ImportedMesh> flatten(const Assimp::Importer& importer, const aiScene* scene) {
    if (!scene) return badInput("cannot be read: " + oneLine(importer.GetErrorString()) + "; export it again");
    return SceneFlattener().run(*scene);
}

engine::Result<ImportedMesh> readByAssimp(const std::filesystem::path& path) {
    Assimp::Importer importer;
    return flatten(importer, importer.ReadFile(path.string(), 0));
}

engine::Result<ImportedMesh> readByAssimp(std::string_view bytes, const std::string& ending) {
    Assimp::Importer importer;
    return flatten(importer, importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, ending.c_str() + 1));
}

// ---- the way from the child -----------------------------------------------------------------------------------------------

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    const uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <class T>
bool extract(std::string_view& bytes, std::vector<T>& values) {
    uint64_t count = 0;
    if (bytes.size() < sizeof count) return false;
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes.remove_prefix(sizeof count);
    if (count > bytes.size() / sizeof(T)) return false;
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return true;
}

constexpr char kIsMesh = 'm', kIsError = 'e';

std::string encode(const engine::Result<ImportedMesh>& mesh) {
    if (!mesh) return kIsError + mesh.error().message;
    std::string bytes(1, kIsMesh);
    append(bytes, mesh->positions);
    append(bytes, mesh->triangles);
    append(bytes, mesh->corner_normals);
    append(bytes, mesh->corner_uvs);
    return bytes;
}

// The child may have been out of its mind: its mesh is believed no more than a file.
engine::Result<ImportedMesh> decode(std::string_view bytes) {
    if (bytes.starts_with(kIsError)) return badInput(oneLine(std::string(bytes.substr(1))));
    ImportedMesh mesh;
    const bool has_marker = bytes.starts_with(kIsMesh);
    if (has_marker) bytes.remove_prefix(1);
    const bool is_whole = has_marker && extract(bytes, mesh.positions) && extract(bytes, mesh.triangles) &&
                          extract(bytes, mesh.corner_normals) && extract(bytes, mesh.corner_uvs) && bytes.empty() &&
                          mesh.corner_normals.size() == 3 * mesh.triangles.size() &&
                          mesh.corner_uvs.size() == 3 * mesh.triangles.size();
    const bool in_range = std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Index3& t) {
        return std::max({t[0], t[1], t[2]}) < mesh.positions.size();
    });
    if (!is_whole || !in_range) return badInput("the reader failed on it; the file is damaged, export it again");
    return mesh;
}

engine::IsolationLimits limitsFor(uintmax_t size) {
    engine::IsolationLimits limits;
    limits.bytes = (uint64_t{1} << 30) + 400 * uint64_t{size};
    return limits;
}

engine::Error failedBy(engine::IsolatedRun::End end, const engine::IsolationLimits& limits) {
    using End = engine::IsolatedRun::End;
    if (end == End::NotBegun) return {engine::ErrorCode::Internal, "no process to be had from the system"};
    if (end == End::OutOfMemory) return badInput("reading it takes too much memory; the file is damaged or too large");
    if (end == End::OutOfTime)
        return badInput("reading it takes longer than " + std::to_string(limits.seconds) + " s; the file is damaged");
    return badInput("the reader failed on it; the file is damaged, export it again");
}

template <class Read>
engine::Result<ImportedMesh> importIsolated(const Read& read, const engine::IsolationLimits& limits) {
    const auto run = engine::runIsolated([&] { return encode(read()); }, limits);
    if (!run.isDone()) return failedBy(run.end, limits);
    return decode(run.answer);
}

using Reader = engine::Result<ImportedMesh> (*)(std::string_view);

// nullptr for endings that are not among them.
Reader ownReader(const std::string& ending) {
    static constexpr std::pair<std::string_view, Reader> kReaders[] = {
        {".obj", readObj}, {".off", readOff}, {".ply", readPly}, {".stl", readStl}};
    for (const auto& [known, reader] : kReaders)
        if (ending == known) return reader;
    return nullptr;
}

engine::Result<void> checkEnding(const std::string& ending) {
    for (const char* known : {".glb", ".gltf", ".fbx", ".dae"})
        if (ending == known) return {};
    if (ownReader(ending)) return {};
    return badInput("a format that is not read; use OBJ, PLY, STL, OFF, GLB, glTF, FBX or DAE");
}

engine::Result<ImportedMesh> importUnnamed(const std::filesystem::path& path) {
    const auto size = fileSize(path);
    if (!size) return size.error();
    const std::string ending = lowerCase(path.extension().string());
    if (auto known = checkEnding(ending); !known) return known.error();
    const Reader reader = ownReader(ending);
    if (!reader) return importIsolated([&] { return readByAssimp(path); }, limitsFor(*size));
    const auto bytes = readBytes(path, *size);
    if (!bytes) return bytes.error();
    return reader(*bytes);
}

} // namespace

engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending,
                                        const engine::IsolationLimits& limits) {
    const std::string lower = lowerCase(std::string(ending));
    if (auto known = checkEnding(lower); !known) return known.error();
    if (bytes.empty()) return badInput("the file is empty");
    try {
        const Reader reader = ownReader(lower);
        return reader ? reader(bytes) : importIsolated([&] { return readByAssimp(bytes, lower); }, limits);
    } catch (const std::exception&) {
        return badInput("cannot be read; too large");
    }
}

engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending) {
    return importMesh(bytes, ending, limitsFor(bytes.size()));
}

engine::Result<ImportedMesh> importMesh(const std::filesystem::path& path) {
    try {
        auto mesh = importUnnamed(path);
        if (!mesh) return engine::Error{mesh.error().code, path.string() + ": " + mesh.error().message};
        return mesh;
    } catch (const std::exception&) { // out of memory, or a name the file system cannot take
        return badInput(path.string() + ": cannot be read; too large, or not a name of a file");
    }
}

} // namespace brittle
