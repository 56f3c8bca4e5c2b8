#include "modules/brittle/mesh/gltf/draco.h"

#include <draco/compression/decode.h>

#include <algorithm>

namespace brittle::gltf {

DracoMesh::DracoMesh(std::string_view compressed, const std::string& where) : where_(where) {
    draco::DecoderBuffer buffer;
    buffer.Init(compressed.data(), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) refuse(where, std::string("its Draco data is damaged (") + decoded.status().error_msg() + ")");
    mesh_ = std::move(decoded).value();
}

DracoMesh::~DracoMesh() = default;

uint64_t DracoMesh::vertexCount() const { return mesh_->num_points(); }

std::vector<uint32_t> DracoMesh::corners() const {
    std::vector<uint32_t> corners;
    corners.reserve(3 * size_t{mesh_->num_faces()});
    for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f)
        for (const draco::PointIndex& point : mesh_->face(f))
            corners.push_back(point.value());
    return corners;
}

std::vector<double> DracoMesh::numbers(uint64_t id, const AccessorShape& shape) const {
    const draco::PointAttribute* attribute = mesh_->GetAttributeByUniqueId(static_cast<uint32_t>(id));
    if (!attribute || id > UINT32_MAX) refuse(where_, "its Draco data has no attribute " + std::to_string(id));
    if (static_cast<uint32_t>(attribute->num_components()) != shape.components)
        refuse(where_, "attribute " + std::to_string(id) + " of its Draco data has " +
                           std::to_string(attribute->num_components()) + " components, must have " +
                           std::to_string(shape.components));
    const double largest = shape.is_normalized && !attribute->normalized() ? largestOf(shape.component_type) : 0;
    std::vector<double> values(vertexCount() * shape.components);
    for (uint32_t v = 0; v < mesh_->num_points(); ++v) {
        double* to = &values[size_t{v} * shape.components];
        const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(v));
        if (at.value() >= attribute->size() || !attribute->ConvertValue<double>(at, static_cast<int8_t>(shape.components), to))
            refuse(where_, "attribute " + std::to_string(id) + " of its Draco data is damaged");
        for (uint32_t c = 0; c < shape.components && largest > 0; ++c)
            to[c] = std::max(to[c] / largest, -1.0);
    }
    return values;
}

} // namespace brittle::gltf
