#include "tests/support/gltf_builder.h"

#include "modules/brittle/mesh/check.h"
#include "modules/brittle/mesh/gltf/gltf.h"
#include "modules/brittle/mesh/prepare.h"
#include "modules/brittle/mesh/readers.h"
#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>

namespace support {

using nlohmann::json;

std::string base64Of(std::string_view bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t k = 0; k < bytes.size(); k += 3) {
        uint32_t group = 0;
        for (size_t b = 0; b < 3; ++b)
            group = group << 8 | (k + b < bytes.size() ? static_cast<uint8_t>(bytes[k + b]) : 0u);
        for (size_t d = 0; d < 4; ++d)
            text += k + d > bytes.size() ? '=' : kDigits[group >> (18 - 6 * d) & 63];
    }
    return text;
}

size_t GltfBuilder::add(const char* list, nlohmann::json element) {
    if (!json.contains(list)) json[list] = nlohmann::json::array();
    json[list].push_back(std::move(element));
    return json[list].size() - 1;
}

size_t GltfBuilder::addView(std::string_view bytes) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    const size_t offset = buffer.size();
    buffer += bytes;
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

size_t GltfBuilder::addNode(nlohmann::json node) {
    const size_t index = add("nodes", std::move(node));
    json["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::string glbOf(const std::vector<std::pair<std::string, std::string>>& chunks) {
    const auto word = [](size_t value) {
        const auto w = static_cast<uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&w), sizeof w);
    };
    std::string body;
    for (auto [type, bytes] : chunks) {
        bytes.resize((bytes.size() + 3) / 4 * 4, type == "JSON" ? ' ' : '\0');
        body += word(bytes.size()) + type + bytes;
    }
    return "glTF" + word(2) + word(12 + body.size()) + body;
}

std::string GltfBuilder::glb() const {
    auto whole = json;
    if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", buffer.size()}}};
    return glbOf({{"JSON", whole.dump()}, {std::string("BIN\0", 4), buffer}});
}

std::string GltfBuilder::gltf() const { return gltf("data:application/octet-stream;base64," + base64Of(buffer)); }

std::string GltfBuilder::gltf(const std::string& uri) const {
    auto whole = json;
    whole["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
    return whole.dump();
}

std::vector<float> cubePositions() {
    std::vector<float> positions;
    for (int k = 0; k < 8; ++k)
        for (int axis = 0; axis < 3; ++axis)
            positions.push_back(k >> axis & 1 ? 1.0f : -1.0f);
    return positions;
}

std::vector<uint16_t> cubeIndices() {
    return {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
}

json cubePrimitive(GltfBuilder& builder) {
    const size_t positions = builder.addAccessor(cubePositions(), "VEC3", 3);
    return {{"attributes", {{"POSITION", positions}}}, {"indices", builder.addAccessor(cubeIndices(), "SCALAR", 1)}};
}

GltfBuilder cubeFile() {
    GltfBuilder builder;
    builder.addNode({{"mesh", builder.addMesh(cubePrimitive(builder))}});
    return builder;
}

GltfBuilder richGltf() {
    GltfBuilder builder = cubeFile();
    json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = builder.addAccessor(std::vector<int8_t>(32, 64), "VEC3", 4, true);
    builder.json["bufferViews"].back()["byteStride"] = 4;
    attributes["TEXCOORD_0"] = builder.addAccessor(std::vector<uint16_t>(16, 1000), "VEC2", 2, true);
    attributes["JOINTS_0"] = builder.addAccessor(std::vector<uint8_t>(32, 0), "VEC4", 4);
    attributes["WEIGHTS_0"] = builder.addAccessor(std::vector<float>(32, 0.25f), "VEC4", 4);
    json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["targets"] = {
        {{"POSITION", builder.add("accessors", {{"componentType", 5126}, {"count", 8}, {"type", "VEC3"}})}}};
    primitive["material"] =
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 0}}}}}});
    nlohmann::json strip = primitive;
    strip["mode"] = 5;
    builder.json["meshes"][0]["primitives"].push_back(strip);
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.add("skins", {{"joints", {1, 2}}});
    builder.add("nodes", {{"children", {2}}, {"rotation", {0, 0, 0, 1}}});
    builder.add("nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}});
    builder.json["nodes"][0]["skin"] = 0;
    const size_t shifts = builder.addAccessor(std::vector<float>{0, 0, 0, 5, 0, 0}, "VEC3", 3);
    const json instances = {{"attributes", {{"TRANSLATION", shifts}}}};
    builder.add("nodes", {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", instances}}}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 3};
    return builder;
}

ReadModel readModel(std::string_view bytes) {
    ReadModel model;
    auto imported = brittle::readGltf(bytes, [](const std::string&) { return brittle::badInput("no such file"); });
    if (!imported) return {imported.error().message, {}, 0, {}, {}, {}, false};
    model.imported = std::move(*imported);
    model.notes = model.imported.notes;
    brittle::Box box;
    for (const brittle::Index3& t : model.imported.triangles)
        for (const uint32_t v : t)
            box.grow(model.imported.positions[v]);
    model.lower = box.lower;
    model.upper = box.upper;
    const auto prepared = brittle::prepareMesh(model.imported);
    if (!prepared) {
        model.refusal = prepared.error().message;
        return model;
    }
    model.was_inside_out = prepared->notes.turned_inside_out;
    const auto report = brittle::checkMesh(prepared->mesh, prepared->topology);
    if (!report) model.refusal = report.error().message;
    if (report) model.volume = report->measures.volume;
    return model;
}

bool hasNote(const ReadModel& model, std::string_view words) {
    return std::ranges::any_of(model.notes, [&](const std::string& note) { return note.find(words) != note.npos; });
}

} // namespace support
