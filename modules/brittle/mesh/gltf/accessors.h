// Numbers of accessors: any component type, normalized or not, interleaved, sparse.
#pragma once

#include "modules/brittle/mesh/gltf/buffers.h"

namespace brittle::gltf {

struct AccessorShape {
    uint64_t count = 0;
    uint64_t component_type = 0; // of OpenGL: 5120 for bytes and so on
    uint32_t components = 0;     // per element, 1 to 16
    bool is_normalized = false;
};

// Largest value of an integer component type, 0 for floats.
double largestOf(uint64_t component_type);

class Accessors {
public:
    Accessors(const Document& document, Buffers& buffers) : document_(document), buffers_(buffers) {}

    // `user` is the place that refers to the accessor, such as "mesh 2, primitive 0, POSITION".
    AccessorShape shape(uint64_t index, const std::string& user) const;
    // All components in order; normalized integers are divided. `components` per element are demanded.
    std::vector<double> numbers(uint64_t index, uint32_t components, const std::string& user);
    // Scalars of an unsigned integer type.
    std::vector<uint32_t> indices(uint64_t index, const std::string& user);

private:
    std::vector<double> read(const Element& accessor, const AccessorShape& shape);
    void replaceSparse(const Element& accessor, const AccessorShape& shape, std::vector<double>& values);

    const Document& document_;
    Buffers& buffers_;
};

} // namespace brittle::gltf
