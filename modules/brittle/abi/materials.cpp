#include "modules/brittle/abi/boundary.h"
#include "modules/brittle/abi/field_names.h"
#include "modules/brittle/effects/material.h"
#include "modules/brittle/scene/check_scene.h"
#include "modules/brittle/scene/scene_keys.h"

namespace {

using namespace brittle::abi;
using brittle::MaterialDescription;

std::optional<double> unlessZero(double value) { return value == 0 ? std::nullopt : std::optional(value); }

// Refuses a name that is no built-in material's. `argument`: what the caller gave it as.
const char* builtinName(const char* name, const char* argument) {
    needed(name, argument);
    if (brittle::findMaterial(name) != nullptr) return name;
    const brittle::SceneKey& like = *brittle::findKey(brittle::sectionOf(brittle::SectionId::Material), "like");
    throw Refusal(BRITTLE_BAD_VALUE,
                  std::string(argument) + " is \"" + name + "\"; it has to be " + brittle::describeAllowed(like));
}

MaterialDescription descriptionOf(const BrittleMaterialDef& def) {
    MaterialDescription material;
    material.name = "own";
    material.like = builtinName(def.like, "like");
    material.density = unlessZero(def.density);
    material.youngs_modulus = unlessZero(def.youngs_modulus);
    material.poisson_ratio = unlessZero(def.poisson_ratio);
    material.fracture_energy = unlessZero(def.fracture_energy);
    material.tensile_strength = unlessZero(def.tensile_strength);
    material.weibull_modulus = unlessZero(def.weibull_modulus);
    material.reference_volume = unlessZero(def.reference_volume);
    material.eta = unlessZero(def.eta);
    material.smallest_cell = unlessZero(def.smallest_cell);
    return material;
}

// Materials are checked as those of a scene, and a scene has a body.
uint64_t addMaterial(BrittleContext& c, MaterialDescription material) {
    brittle::SceneDescription scene;
    scene.bodies.emplace_back();
    scene.materials = {material};
    orRefuseFields(brittle::checkScene(scene));
    return c.materials.add(std::move(material));
}

} // namespace

BrittleResult brittleCreateMaterial(BrittleContext* context, const BrittleMaterialDef* def, BrittleMaterial* material) {
    return bounded(context, [&](BrittleContext& c) {
        const BrittleMaterialDef& d = sized(def, "def");
        BrittleMaterial& out = needed(material, "material");
        out.id = addMaterial(c, descriptionOf(d));
    });
}

BrittleResult brittleFindMaterial(BrittleContext* context, const char* name, BrittleMaterial* material) {
    return bounded(context, [&](BrittleContext& c) {
        MaterialDescription found;
        found.name = "own";
        found.like = builtinName(name, "name");
        BrittleMaterial& out = needed(material, "material");
        out.id = addMaterial(c, std::move(found));
    });
}

BrittleResult brittleDestroyMaterial(BrittleContext* context, BrittleMaterial material) {
    return bounded(context, [&](BrittleContext& c) { c.materials.remove(material.id); });
}
