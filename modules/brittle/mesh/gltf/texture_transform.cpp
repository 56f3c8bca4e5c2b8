#include "modules/brittle/mesh/gltf/texture_transform.h"

#include <cmath>

namespace brittle::gltf {
namespace {

std::optional<Element> textureOf(const Element& material) {
    if (const auto roughness = material.object("pbrMetallicRoughness"))
        for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
            if (auto texture = roughness->object(key)) return texture;
    if (const auto glossiness = material.extension("KHR_materials_pbrSpecularGlossiness"))
        if (auto texture = glossiness->object("diffuseTexture")) return texture;
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        if (auto texture = material.object(key)) return texture;
    return std::nullopt;
}

std::array<double, 2> pairOf(const Element& extension, const char* key, std::array<double, 2> without) {
    const auto numbers = extension.numbers(key, 2);
    return numbers ? std::array<double, 2>{(*numbers)[0], (*numbers)[1]} : without;
}

} // namespace

// The rotation is counter-clockwise as one sees the texture, v down.
std::array<double, 2> TextureTransform::apply(double u, double v) const {
    const double c = std::cos(rotation), s = std::sin(rotation), x = scale[0] * u, y = scale[1] * v;
    return {c * x + s * y + offset[0], -s * x + c * y + offset[1]};
}

TextureTransform textureTransformOf(const Document& document, const Element& primitive) {
    const auto index = primitive.integer("material");
    if (!index) return {};
    const auto texture = textureOf(document.element("materials", *index, primitive.where()));
    if (!texture) return {};
    TextureTransform transform;
    transform.set = texture->integer("texCoord").value_or(0);
    const auto extension = texture->extension("KHR_texture_transform");
    if (!extension) return transform;
    transform.set = extension->integer("texCoord").value_or(transform.set);
    transform.offset = pairOf(*extension, "offset", {0, 0});
    transform.scale = pairOf(*extension, "scale", {1, 1});
    transform.rotation = extension->number("rotation").value_or(0);
    return transform;
}

} // namespace brittle::gltf
