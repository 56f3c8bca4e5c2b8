// Triangles of a mesh's primitives, before any transform.
#pragma once

#include "modules/brittle/mesh/gltf/draco.h"
#include "modules/brittle/mesh/gltf/skin.h"

namespace brittle::gltf {

struct PrimitiveGeometry {
    std::vector<double> positions, normals; // three per vertex; normals may be empty
    std::vector<double> uvs;                // two per vertex, or empty
    Influences influences;
    std::vector<uint32_t> used;    // vertices that have corners, in the order of the corners
    std::vector<Index3> triangles; // of places in `used`
};

class PrimitiveReader {
public:
    PrimitiveReader(const Document& document, Buffers& buffers, Accessors& accessors, Notes& notes)
        : document_(document), buffers_(buffers), accessors_(accessors), notes_(notes) {}

    // nullopt, with a note, for lines, points and primitives without positions.
    std::optional<PrimitiveGeometry> read(const Element& primitive);
    // Adds the morph targets by their weights; weights beyond the targets are left out with a note.
    void morph(const Element& primitive, const std::vector<double>& weights, PrimitiveGeometry& geometry);

private:
    std::unique_ptr<DracoMesh> decodeDraco(const Element& primitive);
    std::vector<uint32_t> readIndices(const Element& primitive, uint64_t vertices);
    void checkType(const std::string& name, const AccessorShape& shape, const std::string& user);
    void noteInfluences(const Element& primitive, const Influences& influences);
    void readAttributes(const Element& primitive, const DracoMesh* draco, PrimitiveGeometry& geometry);
    std::vector<double> attribute(const Element& primitive, const DracoMesh* draco, const std::string& name,
                                  uint32_t components);

    const Document& document_;
    Buffers& buffers_;
    Accessors& accessors_;
    Notes& notes_;
};

} // namespace brittle::gltf
