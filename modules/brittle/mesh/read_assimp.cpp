#include "modules/brittle/mesh/read_assimp.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/interchange/collada_text.h"
#include "modules/brittle/mesh/interchange/fbx_objects.h"
#include "modules/brittle/mesh/model_frame.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/text_reader.h"

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace brittle {
namespace {

Transform toTransform(const aiMatrix4x4& m) {
    const auto row = [&](unsigned r) {
        return Double3{static_cast<double>(m[r][0]), static_cast<double>(m[r][1]), static_cast<double>(m[r][2])};
    };
    return {{row(0), row(1), row(2)},
            {static_cast<double>(m[0][3]), static_cast<double>(m[1][3]), static_cast<double>(m[2][3])}};
}

Double3 doublesOf(const aiVector3D& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

class SceneFlattener {
public:
    // `root` replaces the transform of the root node.
    engine::Result<ImportedMesh> run(const aiScene& scene, const Transform& root);

private:
    struct Visit {
        const aiNode* node;
        Transform transform;
        bool is_flat; // by a scale of 0, of the node or above it
    };
    engine::Result<void> addMeshes(const aiScene& scene, const aiNode& node, const Transform& transform);
    const char* addMesh(const aiMesh& mesh, const Transform& transform);
    PolygonCorner corner(const aiMesh& mesh, uint32_t index, const Transform& transform) const;

    void noteFlatNodes(ImportedMesh& mesh) const;

    MeshBuilder mesh_;
    std::vector<std::string> flat_nodes_; // with meshes, by a scale of 0
    uint32_t first_vertex_ = 0;
    std::vector<PolygonCorner> corners_;
};

engine::Result<ImportedMesh> SceneFlattener::run(const aiScene& scene, const Transform& root) {
    std::vector<Visit> waiting = {{scene.mRootNode, root, false}};
    while (!waiting.empty()) {
        const auto [node, transform, is_flat] = waiting.back();
        waiting.pop_back();
        if (is_flat && node->mNumMeshes > 0) flat_nodes_.push_back('"' + std::string(node->mName.C_Str()) + '"');
        if (!is_flat)
            if (const auto added = addMeshes(scene, *node, transform); !added) return added.error();
        for (unsigned c = node->mNumChildren; c-- > 0;) {
            const Transform local = toTransform(node->mChildren[c]->mTransformation);
            waiting.push_back({node->mChildren[c], transform * local, is_flat || local.isFlat()});
        }
    }
    ImportedMesh mesh = mesh_.take();
    noteFlatNodes(mesh);
    return mesh;
}

engine::Result<void> SceneFlattener::addMeshes(const aiScene& scene, const aiNode& node, const Transform& transform) {
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        if (node.mMeshes[m] >= scene.mNumMeshes) return badInput("a node refers to a mesh that is not there");
        if (const char* wrong = addMesh(*scene.mMeshes[node.mMeshes[m]], transform))
            return badInput("mesh " + std::to_string(node.mMeshes[m]) + ": " + wrong);
    }
    return {};
}

void SceneFlattener::noteFlatNodes(ImportedMesh& mesh) const {
    if (flat_nodes_.empty()) return;
    mesh.notes.push_back(
        formatCount(flat_nodes_.size(), "node that a scale of 0 makes flat is", "nodes that a scale of 0 makes flat are") +
        " left out: " + formatList(flat_nodes_));
}

const char* SceneFlattener::addMesh(const aiMesh& mesh, const Transform& transform) {
    first_vertex_ = static_cast<uint32_t>(mesh_.vertexCount());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const Double3 position = transform.moved(doublesOf(mesh.mVertices[v]));
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
    if (mesh.mNormals) corner.normal = toFloat(normalized(transform.turnedNormal(doublesOf(mesh.mNormals[index])), {0, 0, 0}));
    if (mesh.mTextureCoords[0]) corner.uv = {mesh.mTextureCoords[0][index].x, 1 - mesh.mTextureCoords[0][index].y};
    return corner;
}

// ---- units and axes -------------------------------------------------------------------------------------------------------
// COLLADA: assimp scales and turns the root node by them. FBX: assimp 5.2 leaves them to its user, as metadata; since 5.4 it
// turns the root node, but not to meters. An FBX root has no transform of its own, so that ours may always replace it.

struct RootNotes {
    Transform root;
    std::vector<std::string> notes;
};

template <class T>
T metadata(const aiScene& scene, const char* key, T otherwise) {
    T value = otherwise;
    return scene.mMetaData && scene.mMetaData->Get(key, value) ? value : otherwise;
}

FileAxis fbxAxis(const aiScene& scene, const std::string& name, int otherwise) {
    return {metadata<int32_t>(scene, name.c_str(), otherwise), metadata<int32_t>(scene, (name + "Sign").c_str(), 1)};
}

// Centimeters per unit; 1 where the file does not say.
double fbxUnit(const aiScene& scene) {
    const float as_float = metadata<float>(scene, "UnitScaleFactor", 1);
    return metadata<double>(scene, "UnitScaleFactor", fromShortFloat(as_float));
}

RootNotes fbxRoot(const aiScene& scene) {
    ModelFrame frame{0.01, fbxAxis(scene, "CoordAxis", 0), fbxAxis(scene, "UpAxis", 1), fbxAxis(scene, "FrontAxis", 2)};
    std::vector<std::string> notes;
    if (!isPossible(frame)) {
        notes.push_back("UpAxis, FrontAxis and CoordAxis are no three axes with their signs; taken as y up");
        frame = ModelFrame{0.01, {0, 1}, {1, 1}, {2, 1}};
    }
    const double unit = fbxUnit(scene);
    if (std::isfinite(unit) && unit > 0)
        frame.meters_per_unit = unit / 100;
    else
        notes.push_back("UnitScaleFactor is " + formatNumber(unit) + ", must be above 0; taken as 1 cm");
    for (std::string& note : describeFrame(frame))
        notes.push_back(std::move(note));
    return {toMeters(frame), notes};
}

// In double and by decimals, because 0.01 in float is no hundredth.
RootNotes colladaRoot(const aiScene& scene) {
    const Transform root = toTransform(scene.mRootNode->mTransformation);
    ModelFrame frame;
    if (!findFrame(root, frame)) return {root, {}};
    return {toMeters(frame), describeFrame(frame)};
}

// ---- reading --------------------------------------------------------------------------------------------------------------

// Keeps what assimp warns of, but for looks: parts that it leaves out because they are damaged or refer to nothing.
class WarningList final : public Assimp::LogStream {
public:
    void write(const char* message) override {
        const std::string line = oneLine(message), text = withoutOrigin(line);
        if (isOfLooks(withoutNames(text))) return;
        if (line.starts_with("Error") && first_error_.empty()) first_error_ = text;
        if (warnings_.size() < kMost && std::ranges::find(warnings_, text) == warnings_.end()) warnings_.push_back(text);
    }
    std::vector<std::string> notes() const {
        std::vector<std::string> notes;
        for (const std::string& warning : warnings_)
            notes.push_back("the reader warns: " + warning);
        return notes;
    }

    // Why a part is missing; empty if assimp reports no error.
    const std::string& firstError() const { return first_error_; }

private:
    // A part may be named like a lamp.
    static std::string withoutNames(const std::string& text) {
        std::string rest;
        bool is_name = false;
        for (const char c : text) {
            is_name ^= c == '"';
            if (!is_name) rest += c;
        }
        return rest;
    }
    // Messages begin with "Error, T0: ".
    static std::string withoutOrigin(const std::string& text) {
        const size_t colon = text.find(": ");
        return colon == text.npos ? text : text.substr(colon + 2);
    }
    static bool isOfLooks(const std::string& text) {
        for (const char* word : {"aterial", "exture", "amera", " light", "Light", "nimation"})
            if (text.find(word) != text.npos) return true;
        return false;
    }

    static constexpr size_t kMost = 8;
    std::vector<std::string> warnings_;
    std::string first_error_;
};

// The names of assimp's meshes are the ids of their geometries.
void noteUnusedGeometries(const aiScene& scene, std::set<std::string> geometries, std::vector<std::string>& notes) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        geometries.erase(scene.mMeshes[m]->mName.C_Str());
    if (geometries.empty()) return;
    const bool is_one = geometries.size() == 1;
    notes.push_back(formatCount(geometries.size(), "geometry", "geometries") + " without a mesh in the scene " +
                    (is_one ? "is left out: " : "are left out, such as: ") + *geometries.begin());
}

// A file and what was found in it before assimp reads it.
struct Source {
    std::string ending;
    std::vector<std::string> notes;
    std::set<std::string> geometries; // of COLLADA
};

// No post-processing: its triangulation, for one, asserts on damaged faces.
engine::Result<ImportedMesh> flatten(const Assimp::Importer& importer, const aiScene* scene, const Source& source) {
    if (!scene) return badInput("cannot be read: " + oneLine(importer.GetErrorString()) + "; export it again");
    if (!scene->mRootNode) return badInput("no scene in it; export the model again");
    RootNotes root{toTransform(scene->mRootNode->mTransformation), {}};
    if (source.ending == ".fbx") root = fbxRoot(*scene);
    if (source.ending == ".dae") root = colladaRoot(*scene);
    std::vector<std::string> notes = source.notes;
    noteUnusedGeometries(*scene, source.geometries, notes);
    auto mesh = SceneFlattener().run(*scene, root.root);
    if (!mesh) return mesh;
    notes.insert(notes.begin(), root.notes.begin(), root.notes.end());
    mesh->notes.insert(mesh->notes.begin(), notes.begin(), notes.end());
    return mesh;
}

// Assimp 5.2 does not get over blanks before the numbers of an element, as an exporter for Blender writes them.
std::string withoutBlanksBehindTags(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    bool is_behind_tag = false;
    for (const char c : text) {
        if (is_behind_tag && isBlank(c)) continue;
        is_behind_tag = c == '>';
        result += c;
    }
    return result;
}

// Notes on the unit come first, those on lost parts last.
engine::Error withoutTriangles(const std::vector<std::string>& notes, const std::string& error) {
    const bool has_lost = !notes.empty() && notes.back().find("left out") != std::string::npos;
    const std::string why = !error.empty() ? error : has_lost ? notes.back() : "";
    return badInput("no triangles in it" + (why.empty() ? "" : " (" + why + ")") + "; export the model with its meshes");
}

// Assimp has one logger for all; it is this process's own, which reads one file.
engine::Result<ImportedMesh> readWithNotes(std::string_view bytes, const Source& source) {
    WarningList warnings;
    constexpr unsigned kSevere = Assimp::Logger::Warn | Assimp::Logger::Err;
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0)->attachStream(&warnings, kSevere);
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true); // it makes up a mesh of the nodes otherwise
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, source.ending.c_str() + 1);
    auto mesh = flatten(importer, scene, source);
    Assimp::DefaultLogger::get()->detachStream(&warnings, kSevere);
    Assimp::DefaultLogger::kill();
    if (!mesh) return mesh;
    if (mesh->triangles.empty()) return withoutTriangles(mesh->notes, warnings.firstError());
    for (std::string& note : warnings.notes())
        mesh->notes.push_back(std::move(note));
    return mesh;
}

engine::Result<ImportedMesh> readCollada(std::string_view bytes) {
    auto checked = checkCollada(bytes);
    if (!checked) return checked.error();
    return readWithNotes(withoutBlanksBehindTags(checked->text), {".dae", checked->notes, checked->geometries});
}

} // namespace

engine::Result<ImportedMesh> readByAssimp(const std::filesystem::path& path, const std::string& ending) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    if (!file.is_open() || file.bad()) return badInput("cannot be read; check its permissions");
    return readByAssimp(std::string_view(bytes), ending);
}

engine::Result<ImportedMesh> readByAssimp(std::string_view bytes, const std::string& ending) {
    if (isUtf16(bytes)) return badInput(kUtf16);
    if (ending == ".dae") return readCollada(bytes);
    return readWithNotes(bytes, {ending, noteLostGeometries(bytes), {}});
}

} // namespace brittle
