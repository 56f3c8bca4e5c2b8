#include "modules/brittle/mesh/gltf/primitive.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/gltf/texture_transform.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace brittle::gltf {
namespace {

constexpr const char* kQuantization = "KHR_mesh_quantization";

enum Mode : uint64_t { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

std::vector<Index3> trianglesOf(const std::vector<uint32_t>& indices, uint64_t mode) {
    std::vector<Index3> triangles;
    for (size_t k = 0; mode == kTriangles && k + 2 < indices.size(); k += 3)
        triangles.push_back({indices[k], indices[k + 1], indices[k + 2]});
    for (size_t k = 0; mode == kTriangleStrip && k + 2 < indices.size(); ++k)
        triangles.push_back({indices[k], indices[k + 1 + k % 2], indices[k + 2 - k % 2]});
    for (size_t k = 0; mode == kTriangleFan && k + 2 < indices.size(); ++k)
        triangles.push_back({indices[k + 1], indices[k + 2], indices[0]});
    return triangles;
}

// Makes the triangles refer to places in `used`, so that a primitive adds no more vertices than it has.
void keepUsed(PrimitiveGeometry& geometry) {
    constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> places(geometry.positions.size() / 3, kUnused);
    for (Index3& triangle : geometry.triangles)
        for (uint32_t& corner : triangle) {
            uint32_t& place = places[corner];
            if (place == kUnused) {
                place = static_cast<uint32_t>(geometry.used.size());
                geometry.used.push_back(corner);
            }
            corner = place;
        }
}

void checkIndices(const Element& primitive, const std::vector<uint32_t>& indices, uint64_t vertices) {
    const auto beyond = std::ranges::find_if(indices, [&](uint32_t index) { return index >= vertices; });
    if (beyond != indices.end())
        primitive.refuse("index " + std::to_string(beyond - indices.begin()) + " is " + std::to_string(*beyond) + ", it has " +
                         std::to_string(vertices) + " vertices");
}

// Component types of an attribute by the specification; without KHR_mesh_quantization positions and normals are floats.
bool isCoreType(std::string_view name, const AccessorShape& shape) {
    const bool is_float = largestOf(shape.component_type) == 0;
    const bool is_unsigned = shape.component_type == 5121 || shape.component_type == 5123;
    if (name.starts_with("JOINTS_")) return is_unsigned && !shape.is_normalized;
    if (name.starts_with("TEXCOORD_") || name.starts_with("WEIGHTS_")) return is_float || (is_unsigned && shape.is_normalized);
    return is_float;
}

bool namesQuantization(const Document& document) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        if (const Json* names = document.root().list(list); names && std::ranges::count(*names, kQuantization) > 0) return true;
    return false;
}

bool hasPositions(const Element& primitive) {
    const auto attributes = primitive.object("attributes");
    return attributes && attributes->has("POSITION");
}

} // namespace

std::optional<PrimitiveGeometry> PrimitiveReader::read(const Element& primitive) {
    const uint64_t mode = primitive.integer("mode").value_or(kTriangles);
    if (mode > kTriangleFan) primitive.refuse("mode is " + std::to_string(mode) + ", must be 0 to 6");
    if (mode < kTriangles) {
        notes_.leaveOut("primitive of points or lines", "primitives of points or lines", "only triangles can break");
        return std::nullopt;
    }
    if (!hasPositions(primitive)) {
        notes_.leaveOut("primitive without positions", "primitives without positions", "only positions make a shape");
        return std::nullopt;
    }
    const std::unique_ptr<DracoMesh> draco = decodeDraco(primitive);
    PrimitiveGeometry geometry;
    readAttributes(primitive, draco.get(), geometry);
    const std::vector<uint32_t> indices = draco ? draco->corners() : readIndices(primitive, geometry.positions.size() / 3);
    checkIndices(primitive, indices, geometry.positions.size() / 3);
    const uint64_t read_as = draco ? uint64_t{kTriangles} : mode;
    if (read_as == kTriangles)
        notes_.leaveOut("last corner of a primitive", "last corners of primitives", "three make a triangle",
                        indices.size() % 3);
    geometry.triangles = trianglesOf(indices, read_as);
    keepUsed(geometry);
    return geometry;
}

// nullptr if the primitive is not compressed.
std::unique_ptr<DracoMesh> PrimitiveReader::decodeDraco(const Element& primitive) {
    const auto extension = primitive.extension(kDraco);
    if (!extension) return nullptr;
    const BufferView view = buffers_.view(extension->requiredInteger("bufferView"), extension->where());
    return std::make_unique<DracoMesh>(view.bytes, primitive.where());
}

std::vector<uint32_t> PrimitiveReader::readIndices(const Element& primitive, uint64_t vertices) {
    const auto accessor = primitive.integer("indices");
    if (!accessor) {
        std::vector<uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    return accessors_.indices(*accessor, primitive.where() + ", indices");
}

void PrimitiveReader::readAttributes(const Element& primitive, const DracoMesh* draco, PrimitiveGeometry& geometry) {
    geometry.positions = attribute(primitive, draco, "POSITION", 3);
    const uint64_t vertices = geometry.positions.size() / 3;
    if (vertices > std::numeric_limits<uint32_t>::max()) primitive.refuse("it has too many vertices", "split it");
    const auto checked = [&](const std::string& name, uint32_t components) {
        std::vector<double> values = attribute(primitive, draco, name, components);
        const bool is_given = primitive.requiredObject("attributes").has(name.c_str());
        if (is_given && values.size() != vertices * components)
            primitive.refuse(name + " has " + std::to_string(values.size() / components) + " elements, POSITION has " +
                             std::to_string(vertices));
        return values;
    };
    geometry.normals = checked("NORMAL", 3);
    const TextureTransform transform = textureTransformOf(document_, primitive);
    geometry.uvs = checked("TEXCOORD_" + std::to_string(transform.set), 2);
    for (size_t k = 0; k + 1 < geometry.uvs.size(); k += 2) {
        const auto uv = transform.apply(geometry.uvs[k], geometry.uvs[k + 1]);
        std::ranges::copy(uv, geometry.uvs.begin() + static_cast<std::ptrdiff_t>(k));
    }
    const AttributeSource source = [&](const std::string& name, uint32_t components) { return checked(name, components); };
    geometry.influences = readInfluences(primitive.requiredObject("attributes"), vertices, source);
    noteInfluences(primitive, geometry.influences);
}

// Empty if the primitive has none of that name.
std::vector<double> PrimitiveReader::attribute(const Element& primitive, const DracoMesh* draco, const std::string& name,
                                               uint32_t components) {
    const auto accessor = primitive.requiredObject("attributes").integer(name.c_str());
    if (!accessor) return {};
    const std::string user = primitive.where() + ", " + name;
    const AccessorShape shape = accessors_.shape(*accessor, user);
    checkType(name, shape, user);
    if (draco) {
        const auto id = primitive.extension(kDraco)->requiredObject("attributes").integer(name.c_str());
        if (id && shape.components != components) refuse(user, "must have " + std::to_string(components) + " components");
        if (id) return draco->numbers(*id, shape);
    }
    return accessors_.numbers(*accessor, components, user);
}

// Integers that need an extension are read without it, with a note: they have one meaning.
void PrimitiveReader::checkType(const std::string& name, const AccessorShape& shape, const std::string& user) {
    constexpr uint64_t kUint32 = 5125;
    if (shape.component_type == kUint32) refuse(user, "componentType 5125 is for indices alone");
    if (isCoreType(name, shape) || (!name.starts_with("JOINTS_") && namesQuantization(document_))) return;
    const std::string type = std::to_string(shape.component_type) + (shape.is_normalized ? ", normalized," : "");
    const bool is_quantized = !name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_");
    notes_.add(user + ": componentType " + type + " is read, yet it is not allowed" +
               (is_quantized ? std::string(" without ") + kQuantization : ""));
}

void PrimitiveReader::noteInfluences(const Element& primitive, const Influences& influences) {
    const auto add = [&](uint64_t count, const char* what) {
        if (count > 0) notes_.add(primitive.where() + ": " + formatCount(count, "vertex", "vertices") + " " + what);
    };
    add(influences.scaled, "with joint weights that do not add up to 1: they are scaled to 1");
    add(influences.weightless, "without joint weights: the first joint moves them");
}

void PrimitiveReader::morph(const Element& primitive, const std::vector<double>& weights, PrimitiveGeometry& geometry) {
    const Json* targets = primitive.list("targets");
    const size_t count = targets ? targets->size() : 0;
    for (size_t t = count; t < weights.size(); ++t)
        if (weights[t] != 0) notes_.leaveOut("weight", "weights", "a primitive has fewer morph targets");
    for (size_t t = 0; targets && t < targets->size() && t < weights.size(); ++t) {
        if (weights[t] == 0) continue;
        const Element target((*targets)[t], primitive.where() + ", target " + std::to_string(t));
        const auto add = [&](const char* name, std::vector<double>& values) {
            const auto accessor = target.integer(name);
            if (!accessor || values.empty()) return;
            const std::string user = target.where() + ", " + name;
            checkType(name, accessors_.shape(*accessor, user), user);
            const std::vector<double> change = accessors_.numbers(*accessor, 3, user);
            if (change.size() != values.size())
                target.refuse(std::string(name) + " has another count than that of the primitive");
            for (size_t k = 0; k < values.size(); ++k)
                values[k] += weights[t] * change[k];
        };
        add("POSITION", geometry.positions);
        add("NORMAL", geometry.normals);
    }
}

} // namespace brittle::gltf
