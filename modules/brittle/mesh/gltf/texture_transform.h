// Which texture coordinates a primitive's material uses, and how KHR_texture_transform changes them.
#pragma once

#include "modules/brittle/mesh/gltf/element.h"

#include <array>

namespace brittle::gltf {

struct TextureTransform {
    uint64_t set = 0; // n of TEXCOORD_n
    std::array<double, 2> offset = {0, 0}, scale = {1, 1};
    double rotation = 0; // radians

    std::array<double, 2> apply(double u, double v) const;
};

// Returns that of the base color texture, or of the first other texture. A primitive without textures uses the first set as it
// is.
TextureTransform textureTransformOf(const Document& document, const Element& primitive);

} // namespace brittle::gltf
