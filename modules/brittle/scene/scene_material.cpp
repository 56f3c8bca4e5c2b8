#include "modules/brittle/scene/scene_material.h"

#include "modules/brittle/scene/nearest_name.h"

#include <algorithm>
#include <string>
#include <vector>

namespace brittle {
namespace {

constexpr std::string_view kTempered = "tempered_glass";

engine::Error refuse(const std::string& why) { return {engine::ErrorCode::BadInput, why}; }

engine::Error unknownName(std::string_view name, std::string_view key, std::span<const MaterialDescription> own) {
    std::vector<std::string_view> names;
    for (const Material& card : builtinMaterials())
        names.push_back(card.name);
    for (const MaterialDescription& material : own)
        if (!material.name.empty()) names.push_back(material.name);
    std::string list;
    for (const std::string_view known : names)
        list += (list.empty() ? "; it has to be one of " : ", ") + std::string(known);
    return refuse("unknown " + inQuotes(name) + " in " + inQuotes(key) + didYouMean(name, names, list));
}

} // namespace

bool isTakenName(std::string_view name) { return name == kTempered || findMaterial(name) != nullptr; }

engine::Result<Material> derivedMaterial(const MaterialDescription& material) {
    const Material* like = findMaterial(material.like);
    if (like == nullptr) return unknownName(material.like, "like", {});
    Material card = *like;
    card.name = material.name;
    card.density = material.density.value_or(card.density);
    card.youngs_modulus = material.youngs_modulus.value_or(card.youngs_modulus);
    card.poisson_ratio = material.poisson_ratio.value_or(card.poisson_ratio);
    card.fracture_energy = material.fracture_energy.value_or(card.fracture_energy);
    card.tensile_strength = material.tensile_strength.value_or(card.tensile_strength);
    card.weibull_modulus = material.weibull_modulus.value_or(card.weibull_modulus);
    card.reference_volume = material.reference_volume.value_or(card.reference_volume);
    card.eta = material.eta.value_or(card.eta);
    card.smallest_cell = material.smallest_cell.value_or(card.smallest_cell);
    return card;
}

engine::Result<Material> materialOf(std::string_view name, std::span<const MaterialDescription> own) {
    if (const Material* card = findMaterial(name)) return *card;
    if (name == kTempered)
        return refuse("'tempered_glass' breaks by the stress that it holds, which bodies do not have yet; take 'glass'");
    const auto found = std::ranges::find(own, name, &MaterialDescription::name);
    return found == own.end() || name.empty() ? engine::Result<Material>(unknownName(name, "material", own))
                                              : derivedMaterial(*found);
}

engine::Result<double> densityOf(const BodyDescription& body, std::span<const MaterialDescription> own) {
    if (body.material.empty()) return body.density.value_or(kUsualDensity);
    const auto card = materialOf(body.material, own);
    if (!card) return card.error();
    return body.density.value_or(card->density);
}

} // namespace brittle
