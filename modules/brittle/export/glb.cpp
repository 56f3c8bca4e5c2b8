#include "modules/brittle/export/glb.h"

#include "modules/brittle/collision/collider_mesh.h"
#include "modules/brittle/export/gltf_writer.h"

namespace brittle {
namespace {

class GlbEncoder {
public:
    explicit GlbEncoder(const FragmentSet& set) : set_(set), colliders_(meshesOfColliders(set)) {}
    engine::Result<std::string> run();

private:
    void addColliderMaterial();
    void addFragment(const Fragment& fragment);
    void addCollider(size_t fragment);
    tinygltf::Node& addNode(const char* kind, size_t number);
    tinygltf::Primitive makePrimitive(const FragmentSet& from, const Fragment& fragment, uint32_t first, uint32_t count,
                                      int material);

    const FragmentSet& set_;
    const FragmentSet colliders_;
    GltfWriter writer_;
    tinygltf::Model& model_ = writer_.model();
    int outer_ = 0, inner_ = 0, collider_ = 0; // materials
};

engine::Result<std::string> GlbEncoder::run() {
    outer_ = writer_.addMaterial("outer", kOuterColor);
    inner_ = writer_.addMaterial("inner", kInnerColor);
    for (size_t f = 0; f < set_.fragments.size(); ++f)
        model_.scenes[0].nodes.push_back(static_cast<int>(f));
    for (const Fragment& fragment : set_.fragments)
        addFragment(fragment);
    if (!colliders_.fragments.empty()) addColliderMaterial();
    for (size_t f = 0; f < colliders_.fragments.size(); ++f)
        addCollider(f);
    return writer_.finish("the fragments", "use fewer sites");
}

void GlbEncoder::addColliderMaterial() {
    collider_ = writer_.addMaterial("collider", {0.25, 0.65, 0.95});
    model_.materials.back().pbrMetallicRoughness.baseColorFactor[3] = 0.35;
    model_.materials.back().alphaMode = "BLEND";
}

tinygltf::Value numberList(std::span<const double> numbers) {
    return tinygltf::Value(tinygltf::Value::Array(numbers.begin(), numbers.end()));
}

// With a mesh of the same name, which is the last.
tinygltf::Node& GlbEncoder::addNode(const char* kind, size_t number) {
    std::array<char, 32> name;
    std::snprintf(name.data(), name.size(), "%s_%04zu", kind, number);
    model_.meshes.emplace_back().name = name.data();
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = name.data();
    node.mesh = static_cast<int>(model_.meshes.size() - 1);
    return node;
}

void GlbEncoder::addFragment(const Fragment& fragment) {
    tinygltf::Node& node = addNode("fragment", model_.nodes.size());
    auto& primitives = model_.meshes.back().primitives;
    const uint32_t outer = fragment.outer_index_count - fragment.earlier_index_count;
    const uint32_t inner = fragment.inner_index_count + fragment.earlier_index_count;
    if (outer > 0) primitives.push_back(makePrimitive(set_, fragment, fragment.first_index, outer, outer_));
    if (inner > 0) primitives.push_back(makePrimitive(set_, fragment, fragment.first_index + outer, inner, inner_));
    node.translation.assign(set_.center.begin(), set_.center.end());
    node.extras = tinygltf::Value(tinygltf::Value::Object{{"site", numberList(fragment.site)},
                                                          {"cell", tinygltf::Value(static_cast<int>(fragment.cell))},
                                                          {"volume", tinygltf::Value(fragment.volume)},
                                                          {"center_of_mass", numberList(fragment.centroid)},
                                                          {"inertia", numberList(fragment.inertia)}});
}

// A child of its fragment, which carries the translation.
void GlbEncoder::addCollider(size_t fragment) {
    const Fragment& shape = colliders_.fragments[fragment];
    const ColliderPiece& piece = set_.colliders.pieces[fragment];
    tinygltf::Node& node = addNode("collider", fragment);
    model_.meshes.back().primitives.push_back(
        makePrimitive(colliders_, shape, shape.first_index, shape.vertex_count, collider_));
    node.extras = tinygltf::Value(tinygltf::Value::Object{{"collider", tinygltf::Value(static_cast<int>(fragment))},
                                                          {"planes", tinygltf::Value(static_cast<int>(piece.face_count))},
                                                          {"volume", tinygltf::Value(shape.volume)},
                                                          {"lacks", tinygltf::Value(static_cast<int>(piece.lacks))}});
    model_.nodes[fragment].children.push_back(static_cast<int>(model_.nodes.size() - 1));
}

tinygltf::Primitive GlbEncoder::makePrimitive(const FragmentSet& from, const Fragment& fragment, uint32_t first, uint32_t count,
                                              int material) {
    const std::span vertices = std::span(from.vertices).subspan(fragment.first_vertex);
    return writer_.addPrimitive(cornersOf(vertices, std::span(from.indices).subspan(first, count)), material);
}

} // namespace

engine::Result<std::string> encodeGlb(const FragmentSet& fragments) {
    if (fragments.fragments.empty()) return engine::Error{engine::ErrorCode::Internal, "no fragments to write"};
    return GlbEncoder(fragments).run();
}

} // namespace brittle
