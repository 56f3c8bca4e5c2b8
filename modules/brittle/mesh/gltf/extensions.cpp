#include "modules/brittle/mesh/gltf/extensions.h"

#include <algorithm>

namespace brittle::gltf {
namespace {

constexpr std::string_view kRead[] = {"KHR_mesh_quantization", "KHR_draco_mesh_compression", "KHR_texture_transform",
                                      "EXT_mesh_gpu_instancing", "EXT_meshopt_compression"};

// Extensions that change no shape.
constexpr std::string_view kHarmless[] = {"KHR_xmp",
                                          "KHR_xmp_json_ld",
                                          "KHR_animation_pointer",
                                          "KHR_audio",
                                          "KHR_interactivity",
                                          "EXT_mesh_manifold",
                                          "EXT_mesh_features",
                                          "EXT_structural_metadata",
                                          "EXT_instance_features",
                                          "MSFT_texture_dds",
                                          "MSFT_packing_occlusionRoughnessMetallic"};
constexpr std::string_view kHarmlessBeginnings[] = {"KHR_materials_", "KHR_texture_",    "KHR_lights_", "KHR_technique",
                                                    "EXT_materials_", "EXT_texture_",    "EXT_lights_", "KHR_physics_",
                                                    "FB_material_",   "ADOBE_materials_"};

bool changesNoShape(const std::string& name) {
    return std::ranges::count(kRead, name) + std::ranges::count(kHarmless, name) > 0 ||
           std::ranges::any_of(kHarmlessBeginnings, [&](std::string_view begin) { return name.starts_with(begin); });
}

void noteExtensionsOf(const Element& element, Notes& notes) {
    const auto extensions = element.object("extensions");
    if (!extensions) return;
    for (const auto& [name, value] : extensions->json().items())
        if (!changesNoShape(name)) notes.add("the extension " + name + " is not read; it may change the shape");
}

void noteExtensionsOfPrimitives(const Element& mesh, Notes& notes) {
    const Json* primitives = mesh.list("primitives");
    for (size_t p = 0; primitives && p < primitives->size(); ++p)
        noteExtensionsOf({(*primitives)[p], mesh.where() + ", primitive " + std::to_string(p)}, notes);
}

void checkRequired(const Document& document) {
    const Json* required = document.root().list("extensionsRequired");
    if (!required) return;
    for (const Json& name : *required) {
        if (!name.is_string()) refuse("extensionsRequired", "must be an array of strings");
        const auto text = name.get<std::string>();
        if (!changesNoShape(text))
            refuse("the file", "requires the extension " + text + ", which is not read", "export it without that");
    }
}

} // namespace

void checkVersion(const Document& document) {
    const Element root = document.root();
    // Files of version 1.0 need no asset. They have names where 2.0 has numbers.
    if (!root.has("asset") && root.has("meshes") && root.json()["meshes"].is_object())
        root.refuse("it is glTF 1.0, which is not read", "convert the file to glTF 2.0");
    const Element asset = root.requiredObject("asset");
    const Json* number =
        asset.json().contains("version") && asset.json()["version"].is_number() ? &asset.json()["version"] : nullptr;
    const std::string version = number ? number->dump() : asset.text("version").value_or("");
    const std::string least = asset.text("minVersion").value_or("2.0");
    if (!version.starts_with("2.") && version != "2")
        refuse("asset", "version is \"" + version + "\", must be 2.0", "convert the file to glTF 2.0");
    if (least != "2.0") refuse("asset", "minVersion is \"" + least + "\", must be 2.0", "convert the file to glTF 2.0");
}

void checkExtensions(const Document& document, Notes& notes) {
    checkRequired(document);
    for (const char* list : {"nodes", "scenes", "bufferViews", "accessors", "skins"})
        for (uint64_t k = 0; k < document.size(list); ++k)
            noteExtensionsOf(document.element(list, k, "the file"), notes);
    for (uint64_t k = 0; k < document.size("meshes"); ++k) {
        const Element mesh = document.element("meshes", k, "the file");
        noteExtensionsOf(mesh, notes);
        noteExtensionsOfPrimitives(mesh, notes);
    }
}

} // namespace brittle::gltf
