#include "tests/support/glb_writer.h"

#include <cstdint>
#include <fstream>
#include <vector>

namespace support {
namespace {

using nlohmann::json;
using reference::operator-;
using reference::operator*;
using reference::Point;
using reference::Triangles;

class Writer {
public:
    json document = {{"asset", {{"version", "2.0"}}}, {"materials", json::array({{{"name", "outer"}}, {{"name", "inner"}}})},
                     {"nodes", json::array()},        {"meshes", json::array()},
                     {"accessors", json::array()},    {"bufferViews", json::array()}};
    std::string binary;

    size_t addNumbers(const std::vector<float>& numbers, const std::string& type, size_t width) {
        return addAccessor(numbers.data(), numbers.size() * 4, 5126, numbers.size() / width, type);
    }
    size_t addIndices(const std::vector<uint32_t>& indices) {
        return addAccessor(indices.data(), indices.size() * 4, 5125, indices.size(), "SCALAR");
    }

private:
    size_t addAccessor(const void* data, size_t bytes, int component, size_t count, const std::string& type) {
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}});
        binary.append(static_cast<const char*>(data), bytes);
        const size_t view = document["bufferViews"].size() - 1;
        document["accessors"].push_back({{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
        return document["accessors"].size() - 1;
    }
};

json primitive(Writer& writer, const Triangles& triangles, int material) {
    std::vector<float> positions, normals, uvs;
    std::vector<uint32_t> indices;
    reference::Bounds bounds;
    for (const auto& t : triangles) {
        const Point across = reference::cross(t[1] - t[0], t[2] - t[0]);
        const Point normal = 1 / reference::length(across) * across;
        for (const Point& p : t) {
            for (const double x : p)
                positions.push_back(static_cast<float>(x));
            for (const double x : normal)
                normals.push_back(static_cast<float>(x));
            uvs.insert(uvs.end(), {0, 0});
            indices.push_back(static_cast<uint32_t>(indices.size()));
            bounds.grow(p);
        }
    }
    const size_t position = writer.addNumbers(positions, "VEC3", 3);
    writer.document["accessors"][position]["min"] = bounds.lower;
    writer.document["accessors"][position]["max"] = bounds.upper;
    return {{"attributes",
             {{"POSITION", position},
              {"NORMAL", writer.addNumbers(normals, "VEC3", 3)},
              {"TEXCOORD_0", writer.addNumbers(uvs, "VEC2", 2)}}},
            {"indices", writer.addIndices(indices)},
            {"material", material}};
}

void writeWord(std::ostream& out, size_t word) {
    const uint32_t value = static_cast<uint32_t>(word);
    out.write(reinterpret_cast<const char*>(&value), 4);
}

void writeChunks(const std::string& path, std::string text, const std::string& binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::ofstream out(path, std::ios::binary);
    writeWord(out, 0x46546C67);
    writeWord(out, 2);
    writeWord(out, 12 + 8 + text.size() + 8 + binary.size());
    writeWord(out, text.size());
    writeWord(out, 0x4E4F534A);
    out << text;
    writeWord(out, binary.size());
    writeWord(out, 0x004E4942);
    out << binary;
}

} // namespace

void writeFragmentFile(const std::string& path, const reference::FragmentFile& file,
                       const std::function<void(nlohmann::json&)>& change) {
    Writer writer;
    for (const reference::Piece& piece : file.pieces) {
        json mesh = {{"primitives", json::array()}};
        if (!piece.outer.empty()) mesh["primitives"].push_back(primitive(writer, piece.outer, 0));
        if (!piece.inner.empty()) mesh["primitives"].push_back(primitive(writer, piece.inner, 1));
        writer.document["nodes"].push_back(
            {{"name", piece.name},
             {"mesh", writer.document["meshes"].size()},
             {"translation", piece.translation},
             {"extras", {{"site", piece.site}, {"cell", piece.cell}, {"volume", piece.volume}}}});
        writer.document["meshes"].push_back(mesh);
    }
    writer.document["buffers"] = json::array({{{"byteLength", writer.binary.size()}}});
    if (change) change(writer.document);
    writeChunks(path, writer.document.dump(), writer.binary);
}

} // namespace support
