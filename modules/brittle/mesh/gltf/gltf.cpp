#include "modules/brittle/mesh/gltf/gltf.h"

#include "modules/brittle/mesh/gltf/container.h"
#include "modules/brittle/mesh/gltf/extensions.h"
#include "modules/brittle/mesh/gltf/primitive.h"
#include "modules/brittle/mesh/readers.h"

#include <algorithm>

namespace brittle {
namespace gltf {
namespace {

// Weights of the morph targets; empty if none of them changes anything.
std::vector<double> targetWeights(const Element& mesh, const Element& node) {
    auto weights = node.numbers("weights");
    if (!weights) weights = mesh.numbers("weights");
    const bool is_changed = weights && std::ranges::any_of(*weights, [](double w) { return w != 0; });
    return is_changed ? *weights : std::vector<double>();
}

class Flattener {
public:
    Flattener(const Document& document, Buffers& buffers, uint64_t most_elements)
        : document_(document), accessors_(document, buffers), primitives_(document, buffers, accessors_, notes_),
          most_elements_(most_elements) {}
    void noteBytesBehind(size_t count) {
        notes_.leaveOut("byte behind the GLB", "bytes behind the GLB", "its header ends before them", count);
    }
    ImportedMesh run();

private:
    void addMesh(const Element& mesh, const std::vector<uint64_t>& nodes);
    void addPlaced(const Element& primitive, const PrimitiveGeometry& geometry, const Element& node, const Transform& world);
    void addSkinned(const Element& primitive, const PrimitiveGeometry& geometry, const Element& node);
    void checkLimit(const Element& primitive, const PrimitiveGeometry& geometry) const;
    template <class TransformAt>
    void addInstance(const Element& primitive, const PrimitiveGeometry& geometry, const TransformAt& transform_at);

    const Document& document_;
    Notes notes_;
    Accessors accessors_;
    PrimitiveReader primitives_;
    Scene scene_;
    uint64_t most_elements_;
    MeshBuilder mesh_;
};

ImportedMesh Flattener::run() {
    checkVersion(document_);
    checkExtensions(document_, notes_);
    scene_ = readScene(document_, notes_);
    std::vector<uint64_t> order; // meshes by their first node
    std::map<uint64_t, std::vector<uint64_t>> nodes;
    for (const uint64_t n : scene_.mesh_nodes) {
        const uint64_t mesh = document_.element("nodes", n, "the scene").requiredInteger("mesh");
        if (nodes[mesh].empty()) order.push_back(mesh);
        nodes[mesh].push_back(n);
    }
    for (const uint64_t mesh : order)
        addMesh(document_.element("meshes", mesh, "node " + std::to_string(nodes[mesh].front())), nodes[mesh]);
    const std::vector<std::string> notes = notes_.sentences();
    if (mesh_.triangleCount() == 0) {
        const std::string why = notes.empty() ? "" : " (" + notes.front() + ")";
        refuse("the scene", "it has no triangles" + why, "export the model with its meshes");
    }
    ImportedMesh mesh = mesh_.take();
    mesh.notes = notes;
    return mesh;
}

void Flattener::addMesh(const Element& mesh, const std::vector<uint64_t>& nodes) {
    const Json* primitives = mesh.list("primitives");
    if (!primitives) mesh.refuse("primitives are missing");
    for (size_t p = 0; p < primitives->size(); ++p) {
        const Element primitive((*primitives)[p], mesh.where() + ", primitive " + std::to_string(p));
        const auto geometry = primitives_.read(primitive);
        if (!geometry) continue;
        for (const uint64_t n : nodes) {
            const Element node = document_.element("nodes", n, "the scene");
            const std::vector<double> weights = targetWeights(mesh, node);
            if (weights.empty()) {
                addPlaced(primitive, *geometry, node, scene_.worlds[n]);
                continue;
            }
            PrimitiveGeometry morphed = *geometry;
            primitives_.morph(primitive, weights, morphed);
            addPlaced(primitive, morphed, node, scene_.worlds[n]);
        }
    }
}

// A skin replaces the transform of its node.
void Flattener::addPlaced(const Element& primitive, const PrimitiveGeometry& geometry, const Element& node,
                          const Transform& world) {
    if (node.has("skin") && !geometry.influences.isEmpty()) return addSkinned(primitive, geometry, node);
    if (node.has("skin")) notes_.add(primitive.where() + " has a skin but no joints: it stands where its node is");
    for (const Transform& instance : instancesOf(node, accessors_)) {
        const Transform transform = world * instance;
        addInstance(primitive, geometry, [&](uint32_t) -> const Transform& { return transform; });
    }
}

void Flattener::addSkinned(const Element& primitive, const PrimitiveGeometry& geometry, const Element& node) {
    if (node.extension(kInstancing)) notes_.add("instances of " + node.where() + " are left out: it has a skin");
    const std::vector<Transform> joints =
        jointMatrices(document_, node.requiredInteger("skin"), node.where(), scene_, accessors_);
    addInstance(primitive, geometry,
                [&](uint32_t vertex) { return blend(geometry.influences, joints, vertex, primitive.where()); });
}

PolygonCorner cornerOf(const PrimitiveGeometry& geometry, uint32_t vertex, const Transform& transform) {
    PolygonCorner corner;
    const double* normal = geometry.normals.empty() ? nullptr : &geometry.normals[size_t{3} * vertex];
    if (normal) corner.normal = toFloat(normalized(transform.turnedNormal({normal[0], normal[1], normal[2]}), {0, 0, 0}));
    const double* uv = geometry.uvs.empty() ? nullptr : &geometry.uvs[size_t{2} * vertex];
    const bool has_uv = uv && std::isfinite(uv[0]) && std::isfinite(uv[1]);
    if (has_uv) corner.uv = {static_cast<float>(uv[0]), static_cast<float>(uv[1])};
    return corner;
}

void Flattener::checkLimit(const Element& primitive, const PrimitiveGeometry& geometry) const {
    if (mesh_.vertexCount() + geometry.used.size() > most_elements_ ||
        mesh_.triangleCount() + geometry.triangles.size() > most_elements_)
        primitive.refuse("with it and all instances there are more than " + std::to_string(most_elements_) +
                             " vertices or triangles",
                         "make the model simpler");
}

// `transform_at` gives the transform of a vertex of the primitive.
template <class TransformAt>
void Flattener::addInstance(const Element& primitive, const PrimitiveGeometry& geometry, const TransformAt& transform_at) {
    checkLimit(primitive, geometry);
    std::vector<PolygonCorner> corners(geometry.used.size());
    std::vector<double> determinants(geometry.used.size());
    for (size_t k = 0; k < corners.size(); ++k) {
        const uint32_t vertex = geometry.used[k];
        const Transform& transform = transform_at(vertex);
        const double* p = &geometry.positions[size_t{3} * vertex];
        const Double3 position = transform.moved({p[0], p[1], p[2]});
        if (!isFinite(position)) refuse(primitive.where() + ", vertex " + std::to_string(vertex), kNotFinite, "");
        corners[k] = cornerOf(geometry, vertex, transform);
        corners[k].position = static_cast<uint32_t>(mesh_.vertexCount());
        determinants[k] = transform.determinant();
        mesh_.addVertex(position);
    }
    for (const Index3& t : geometry.triangles) {
        std::array<PolygonCorner, 3> polygon = {corners[t[0]], corners[t[1]], corners[t[2]]};
        const bool is_mirrored = determinants[t[0]] + determinants[t[1]] + determinants[t[2]] < 0;
        if (is_mirrored) std::ranges::reverse(polygon);
        mesh_.addPolygon(polygon); // never refuses three corners
    }
}

engine::Result<ImportedMesh> read(std::string_view bytes, const ReadNeighbor& read_neighbor, uint64_t most_elements) {
    const Container container = splitContainer(bytes);
    const Document document(container.json);
    Buffers buffers(document, container.has_binary ? std::optional(container.binary) : std::nullopt, read_neighbor);
    buffers.countBytes(bytes.size());
    Flattener flattener(document, buffers, most_elements);
    flattener.noteBytesBehind(container.bytes_behind);
    return flattener.run();
}

} // namespace
} // namespace gltf

engine::Result<ImportedMesh> readGltf(std::string_view bytes, const ReadNeighbor& read_neighbor, uint64_t most_elements) {
    try {
        return gltf::read(bytes, read_neighbor, most_elements);
    } catch (const gltf::Refusal& refusal) {
        return badInput(refusal.message);
    } catch (const std::bad_alloc&) {
        return badInput("reading it takes too much memory; the file is damaged or too large");
    } catch (const std::exception&) {
        return badInput("the reader failed on it; the file is damaged, export it again");
    }
}

} // namespace brittle
