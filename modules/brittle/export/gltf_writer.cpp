#define TINYGLTF_IMPLEMENTATION
#include "modules/brittle/export/gltf_writer.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <bit>
#include <sstream>

namespace brittle {
namespace {

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

template <class T>
void append(std::vector<unsigned char>& data, const T& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    data.insert(data.end(), bytes, bytes + sizeof value);
}

std::array<FragmentVertex, 3> tidied(std::array<FragmentVertex, 3> corners) {
    const Double3 a = positionOf(corners[0]);
    const Double3 face_normal = normalized(cross(positionOf(corners[1]) - a, positionOf(corners[2]) - a), {0, 0, 1});
    for (FragmentVertex& corner : corners)
        tidyNormal(corner, face_normal);
    return corners;
}

int typeOf(int width) { return width == 1 ? TINYGLTF_TYPE_SCALAR : width == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4; }

} // namespace

std::vector<FragmentVertex> cornersOf(std::span<const FragmentVertex> vertices, std::span<const uint32_t> indices) {
    std::vector<FragmentVertex> corners;
    corners.reserve(indices.size());
    for (const uint32_t index : indices)
        corners.push_back(vertices[index]);
    return corners;
}

GltfWriter::GltfWriter() {
    model_.asset.version = "2.0";
    model_.asset.generator = "brittle";
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
}

int GltfWriter::addMaterial(const char* name, std::array<double, 3> color) {
    tinygltf::Material& material = model_.materials.emplace_back();
    material.name = name;
    material.pbrMetallicRoughness.baseColorFactor = {color[0], color[1], color[2], 1};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    return static_cast<int>(model_.materials.size() - 1);
}

tinygltf::Primitive GltfWriter::addPrimitive(std::span<const FragmentVertex> corners, int material) {
    VertexSet set(corners.size());
    const size_t index_offset = data_[kIndices].size();
    for (size_t k = 0; k < corners.size(); k += 3)
        for (const FragmentVertex& corner : tidied({corners[k], corners[k + 1], corners[k + 2]}))
            append(data_[kIndices], set.indexOf(corner));
    const std::array offsets = {data_[kPositions].size(), data_[kNormals].size(), data_[kUvs].size()};
    for (const FragmentVertex& vertex : set.vertices()) {
        append(data_[kPositions], vertex.position);
        append(data_[kNormals], vertex.normal);
        append(data_[kUvs], vertex.uv);
    }
    const size_t count = set.vertices().size();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    const int positions = addAccessor(kPositions, offsets[0], count, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    addBounds(set.vertices(), model_.accessors.back());
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"] =
        addAccessor(kNormals, offsets[1], count, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    primitive.attributes["TEXCOORD_0"] =
        addAccessor(kUvs, offsets[2], count, TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT);
    primitive.indices =
        addAccessor(kIndices, index_offset, corners.size(), TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    return primitive;
}

int GltfWriter::addNumbers(View view, std::span<const float> numbers, int width) {
    const size_t offset = data_[view].size();
    const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
    data_[view].insert(data_[view].end(), bytes, bytes + numbers.size_bytes());
    const int accessor =
        addAccessor(view, offset, numbers.size() / static_cast<size_t>(width), typeOf(width), TINYGLTF_COMPONENT_TYPE_FLOAT);
    if (width == 1) {
        const auto [least, greatest] = std::ranges::minmax(numbers);
        model_.accessors.back().minValues = {double{least}};
        model_.accessors.back().maxValues = {double{greatest}};
    }
    return accessor;
}

int GltfWriter::addAccessor(View view, size_t offset, size_t count, int type, int component) {
    tinygltf::Accessor& accessor = model_.accessors.emplace_back();
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.count = count;
    accessor.type = type;
    accessor.componentType = component;
    return static_cast<int>(model_.accessors.size() - 1);
}

void GltfWriter::addBounds(const std::vector<FragmentVertex>& vertices, tinygltf::Accessor& accessor) const {
    Box box;
    for (const FragmentVertex& vertex : vertices)
        box.grow(positionOf(vertex));
    accessor.minValues.assign(box.lower.begin(), box.lower.end());
    accessor.maxValues.assign(box.upper.begin(), box.upper.end());
}

size_t GltfWriter::bytes() const {
    size_t bytes = 0;
    for (const auto& data : data_)
        bytes += data.size();
    return bytes;
}

void GltfWriter::joinViews() {
    static constexpr std::array<size_t, kViewCount> kStrides = {12, 12, 8, 0, 0, 0, 0, 0};
    tinygltf::Buffer& buffer = model_.buffers.emplace_back();
    std::array<int, kViewCount> index_of = {}; // the format has no empty views
    for (size_t k = 0; k < kViewCount; ++k) {
        if (data_[k].empty()) continue;
        index_of[k] = static_cast<int>(model_.bufferViews.size());
        tinygltf::BufferView& view = model_.bufferViews.emplace_back();
        view.buffer = 0;
        view.byteOffset = buffer.data.size();
        view.byteLength = data_[k].size();
        view.byteStride = kStrides[k];
        if (k < kTimes) view.target = k == kIndices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER : TINYGLTF_TARGET_ARRAY_BUFFER;
        buffer.data.insert(buffer.data.end(), data_[k].begin(), data_[k].end());
        data_[k] = {};
    }
    for (tinygltf::Accessor& accessor : model_.accessors)
        accessor.bufferView = index_of[static_cast<size_t>(accessor.bufferView)];
}

engine::Result<std::string> GltfWriter::finish(const char* what, const char* advice) {
    if (bytes() > kMaxGlbBytes)
        return engine::Error{engine::ErrorCode::Capacity, std::string(what) + " exceed the 4 GiB of a GLB file; " + advice};
    joinViews();
    std::ostringstream out;
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, true))
        return engine::Error{engine::ErrorCode::Internal, "the GLB could not be put together"};
    return std::move(out).str();
}

} // namespace brittle
