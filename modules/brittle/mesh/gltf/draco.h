// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include "modules/brittle/mesh/gltf/accessors.h"

#include <memory>

namespace draco {
class Mesh;
}

namespace brittle::gltf {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

class DracoMesh {
public:
    // `where` names the primitive, for errors.
    DracoMesh(std::string_view compressed, const std::string& where);
    ~DracoMesh();
    DracoMesh(const DracoMesh&) = delete;
    DracoMesh& operator=(const DracoMesh&) = delete;

    uint64_t vertexCount() const;
    std::vector<uint32_t> corners() const;
    // Numbers of the attribute with that id, as an accessor of that shape would give them.
    std::vector<double> numbers(uint64_t id, const AccessorShape& shape) const;

private:
    std::unique_ptr<draco::Mesh> mesh_;
    std::string where_;
};

} // namespace brittle::gltf
