#include "modules/brittle/export/glb.h"

#include "modules/brittle/collision/collider_mesh.h"
#include "modules/brittle/mesh/vector_math.h"

// The only file that sees tinygltf.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <bit>
#include <span>
#include <sstream>

namespace brittle {
namespace {

enum View { kPositions, kNormals, kUvs, kIndices, kViewCount };
enum Material { kOuter, kInner, kCollider };

constexpr size_t kMaxBytes = 0xffff0000; // lengths in the file have 32 bits

// Vertices of one primitive, each kept once.
class VertexSet {
public:
    explicit VertexSet(size_t most) : slots_(std::bit_ceil(2 * most + 2), kEmpty) {}

    uint32_t indexOf(const FragmentVertex& vertex) {
        const auto words = std::bit_cast<Words>(vertex);
        uint64_t hash = 0;
        for (const uint64_t word : words) {
            hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 31;
        }
        for (size_t slot = hash;; ++slot) {
            uint32_t& entry = slots_[slot & (slots_.size() - 1)];
            if (entry == kEmpty) {
                entry = static_cast<uint32_t>(vertices_.size());
                vertices_.push_back(vertex);
            }
            if (std::bit_cast<Words>(vertices_[entry]) == words) return entry;
        }
    }
    const std::vector<FragmentVertex>& vertices() const { return vertices_; }

private:
    using Words = std::array<uint64_t, 4>; // by their bits: -0 is not 0 here, and what is no number equals itself
    static constexpr uint32_t kEmpty = 0xffffffff;
    std::vector<uint32_t> slots_;
    std::vector<FragmentVertex> vertices_;
};

// Interpolation leaves normals a little short, and the format asks for unit length. Where there is none the triangle's serves.
void tidyNormal(FragmentVertex& vertex, const Double3& face_normal) {
    const Double3 normal = toDouble({vertex.normal[0], vertex.normal[1], vertex.normal[2]});
    const Float3 tidy = toFloat(normalized(normal, face_normal));
    std::copy(tidy.begin(), tidy.end(), vertex.normal);
}

class GlbEncoder {
public:
    explicit GlbEncoder(const FragmentSet& set) : set_(set), colliders_(meshesOfColliders(set)) {}
    engine::Result<std::string> run();

private:
    void addMaterial(const char* name, std::array<double, 3> color);
    void addColliderMaterial();
    void addFragment(const Fragment& fragment);
    void addCollider(size_t fragment);
    tinygltf::Primitive makePrimitive(const FragmentSet& from, const Fragment& fragment, uint32_t first, uint32_t count,
                                      Material material);
    int addAccessor(View view, size_t offset, size_t count, int type, int component);
    void addBounds(const std::vector<FragmentVertex>& vertices, tinygltf::Accessor& accessor) const;
    void joinViews();

    const FragmentSet& set_;
    const FragmentSet colliders_;
    tinygltf::Model model_;
    std::array<std::vector<unsigned char>, kViewCount> data_;
};

template <class T>
void append(std::vector<unsigned char>& data, const T& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    data.insert(data.end(), bytes, bytes + sizeof value);
}

engine::Result<std::string> GlbEncoder::run() {
    model_.asset.version = "2.0";
    model_.asset.generator = "brittle";
    addMaterial("outer", {0.72, 0.74, 0.78});
    addMaterial("inner", {0.90, 0.38, 0.14});
    tinygltf::Scene& scene = model_.scenes.emplace_back();
    for (size_t f = 0; f < set_.fragments.size(); ++f)
        scene.nodes.push_back(static_cast<int>(f));
    model_.defaultScene = 0;
    for (const Fragment& fragment : set_.fragments)
        addFragment(fragment);
    if (!colliders_.fragments.empty()) addColliderMaterial();
    for (size_t f = 0; f < colliders_.fragments.size(); ++f)
        addCollider(f);
    joinViews();
    if (model_.buffers[0].data.size() > kMaxBytes)
        return engine::Error{engine::ErrorCode::Capacity, "the fragments exceed the 4 GiB of a GLB file; use fewer sites"};
    std::ostringstream out;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, true))
        return engine::Error{engine::ErrorCode::Internal, "the GLB could not be put together"};
    return std::move(out).str();
}

void GlbEncoder::addMaterial(const char* name, std::array<double, 3> color) {
    tinygltf::Material& material = model_.materials.emplace_back();
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {color[0], color[1], color[2], 1};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
}

void GlbEncoder::addColliderMaterial() {
    addMaterial("collider", {0.25, 0.65, 0.95});
    model_.materials.back().pbrMetallicRoughness.baseColorFactor[3] = 0.35;
    model_.materials.back().alphaMode = "BLEND";
}

tinygltf::Value numberList(std::span<const double> numbers) {
    return tinygltf::Value(tinygltf::Value::Array(numbers.begin(), numbers.end()));
}

void GlbEncoder::addFragment(const Fragment& fragment) {
    std::array<char, 32> name;
    std::snprintf(name.data(), name.size(), "fragment_%04zu", model_.nodes.size());
    tinygltf::Mesh& mesh = model_.meshes.emplace_back();
    mesh.name = name.data();
    const uint32_t outer = fragment.outer_index_count - fragment.earlier_index_count;
    const uint32_t inner = fragment.inner_index_count + fragment.earlier_index_count;
    if (outer > 0) mesh.primitives.push_back(makePrimitive(set_, fragment, fragment.first_index, outer, kOuter));
    if (inner > 0) mesh.primitives.push_back(makePrimitive(set_, fragment, fragment.first_index + outer, inner, kInner));
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = name.data();
    node.mesh = static_cast<int>(model_.meshes.size() - 1);
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
    std::array<char, 32> name;
    std::snprintf(name.data(), name.size(), "collider_%04zu", fragment);
    tinygltf::Mesh& mesh = model_.meshes.emplace_back();
    mesh.name = name.data();
    mesh.primitives.push_back(makePrimitive(colliders_, shape, shape.first_index, shape.vertex_count, kCollider));
    tinygltf::Node& node = model_.nodes.emplace_back();
    node.name = name.data();
    node.mesh = static_cast<int>(model_.meshes.size() - 1);
    node.extras = tinygltf::Value(tinygltf::Value::Object{{"collider", tinygltf::Value(static_cast<int>(fragment))},
                                                          {"planes", tinygltf::Value(static_cast<int>(piece.face_count))},
                                                          {"volume", tinygltf::Value(shape.volume)},
                                                          {"lacks", tinygltf::Value(static_cast<int>(piece.lacks))}});
    model_.nodes[fragment].children.push_back(static_cast<int>(model_.nodes.size() - 1));
}

std::array<FragmentVertex, 3> triangleOf(const FragmentSet& set, const Fragment& fragment, uint32_t first) {
    std::array<FragmentVertex, 3> corners;
    for (uint32_t k = 0; k < 3; ++k)
        corners[k] = set.vertices[fragment.first_vertex + set.indices[first + k]];
    const Double3 a = positionOf(corners[0]);
    const Double3 face_normal = normalized(cross(positionOf(corners[1]) - a, positionOf(corners[2]) - a), {0, 0, 1});
    for (FragmentVertex& corner : corners)
        tidyNormal(corner, face_normal);
    return corners;
}

tinygltf::Primitive GlbEncoder::makePrimitive(const FragmentSet& from, const Fragment& fragment, uint32_t first, uint32_t count,
                                              Material material) {
    VertexSet set(count);
    const size_t index_offset = data_[kIndices].size();
    for (uint32_t k = 0; k < count; k += 3)
        for (const FragmentVertex& corner : triangleOf(from, fragment, first + k))
            append(data_[kIndices], set.indexOf(corner));
    const std::array offsets = {data_[kPositions].size(), data_[kNormals].size(), data_[kUvs].size()};
    for (const FragmentVertex& vertex : set.vertices()) {
        append(data_[kPositions], vertex.position);
        append(data_[kNormals], vertex.normal);
        append(data_[kUvs], vertex.uv);
    }
    const size_t vertex_count = set.vertices().size();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    const int positions = addAccessor(kPositions, offsets[0], vertex_count, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    addBounds(set.vertices(), model_.accessors.back());
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"] =
        addAccessor(kNormals, offsets[1], vertex_count, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    primitive.attributes["TEXCOORD_0"] =
        addAccessor(kUvs, offsets[2], vertex_count, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT);
    primitive.indices = addAccessor(kIndices, index_offset, count, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    return primitive;
}

int GlbEncoder::addAccessor(View view, size_t offset, size_t count, int type, int component) {
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.count = count;
    accessor.type = type;
    accessor.componentType = component;
    return static_cast<int>(model_.accessors.size() - 1);
}

void GlbEncoder::addBounds(const std::vector<FragmentVertex>& vertices, tinygltf::Accessor& accessor) const {
    Box box;
    for (const FragmentVertex& vertex : vertices)
        box.grow(positionOf(vertex));
    accessor.minValues.assign(box.lower.begin(), box.lower.end());
    accessor.maxValues.assign(box.upper.begin(), box.upper.end());
}

// One buffer with a view for each kind of data: 20,000 fragments need 80,000 accessors, but not as many views.
void GlbEncoder::joinViews() {
    static constexpr std::array<size_t, kViewCount> kStrides = {12, 12, 8, 0};
    tinygltf::Buffer& buffer = model_.buffers.emplace_back();
    for (size_t k = 0; k < kViewCount; ++k) {
        tinygltf::BufferView& view = model_.bufferViews.emplace_back();
        view.buffer = 0;
        view.byteOffset = buffer.data.size();
        view.byteLength = data_[k].size();
        view.byteStride = kStrides[k];
        view.target = k == kIndices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER : TINYGLTF_TARGET_ARRAY_BUFFER;
        buffer.data.insert(buffer.data.end(), data_[k].begin(), data_[k].end());
        data_[k] = {};
    }
}

} // namespace

engine::Result<std::string> encodeGlb(const FragmentSet& fragments) {
    if (fragments.fragments.empty()) return engine::Error{engine::ErrorCode::Internal, "no fragments to write"};
    return GlbEncoder(fragments).run();
}

} // namespace brittle
