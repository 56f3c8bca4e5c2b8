// Builds small glTF files for tests of the reader. Tests may change `json` and `buffer` before they write the file.
#pragma once

#include "modules/brittle/mesh/imported_mesh.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace support {

std::string base64Of(std::string_view bytes);

// Component types of glTF.
template <class T>
constexpr int kComponentType = 0;
template <>
inline constexpr int kComponentType<int8_t> = 5120;
template <>
inline constexpr int kComponentType<uint8_t> = 5121;
template <>
inline constexpr int kComponentType<int16_t> = 5122;
template <>
inline constexpr int kComponentType<uint16_t> = 5123;
template <>
inline constexpr int kComponentType<uint32_t> = 5125;
template <>
inline constexpr int kComponentType<float> = 5126;

class GltfBuilder {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", nlohmann::json::array()}}}}};
    std::string buffer;

    // These return the index of the new element.
    size_t add(const char* list, nlohmann::json element);
    size_t addView(std::string_view bytes);
    template <class T>
    size_t addAccessor(const std::vector<T>& values, const char* type, size_t components, bool is_normalized = false) {
        const size_t view = addView({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
        nlohmann::json accessor = {
            {"bufferView", view}, {"componentType", kComponentType<T>}, {"count", values.size() / components}, {"type", type}};
        if (is_normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }
    size_t addMesh(nlohmann::json primitive) { return add("meshes", {{"primitives", {std::move(primitive)}}}); }
    // Also adds the node to scene 0.
    size_t addNode(nlohmann::json node);

    std::string glb() const;
    std::string gltf() const; // with the buffer as a data: URI
    // Text that refers to the buffer by that URI.
    std::string gltf(const std::string& uri) const;
};

// A GLB of these chunks; the first is JSON, types are four letters.
std::string glbOf(const std::vector<std::pair<std::string, std::string>>& chunks);

// The cube from -1 to 1 on each axis: 8 positions, 36 indices, outward.
std::vector<float> cubePositions();
std::vector<uint16_t> cubeIndices();
nlohmann::json cubePrimitive(GltfBuilder& builder);
// One node with the cube.
GltfBuilder cubeFile();
// Uses every part of the reader except the decoders of other libraries.
GltfBuilder richGltf();

// A file that was read, prepared and checked. `refusal` is the error of the first step that failed.
struct ReadModel {
    std::string refusal;
    std::vector<std::string> notes;
    double volume = 0;
    brittle::Double3 lower = {0, 0, 0}, upper = {0, 0, 0}; // of the triangles' corners
    brittle::ImportedMesh imported;
    bool was_inside_out = false;
};
ReadModel readModel(std::string_view bytes);
inline ReadModel readModel(const GltfBuilder& builder) { return readModel(builder.glb()); }

// True if one of the notes holds these words.
bool hasNote(const ReadModel& model, std::string_view words);

} // namespace support
