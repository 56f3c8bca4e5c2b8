#include "tests/reference/glb_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace reference {
namespace {

using Json = nlohmann::json;

constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126, kTriangles = 4;

void require(bool condition, const std::string& what) {
    if (!condition) throw std::runtime_error("GLB: " + what);
}

struct Chunks {
    Json json;
    std::vector<char> binary;
};

uint32_t wordAt(const std::vector<char>& bytes, size_t offset) {
    require(offset + 4 <= bytes.size(), "ends within a header");
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, 4);
    return word;
}

Chunks readChunks(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    require(file.good(), "cannot open " + path);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
    require(wordAt(bytes, 0) == kMagic && wordAt(bytes, 4) == 2, "not a GLB of version 2");
    require(wordAt(bytes, 8) == bytes.size(), "length in the header is not the file's");
    Chunks chunks;
    for (size_t at = 12; at < bytes.size();) {
        const size_t size = wordAt(bytes, at), kind = wordAt(bytes, at + 4), first = at + 8;
        require(first + size <= bytes.size(), "a chunk runs past the end");
        const char* data = bytes.data() + first;
        if (kind == kJsonChunk) chunks.json = Json::parse(data, data + size);
        if (kind == kBinaryChunk) chunks.binary.assign(data, data + size);
        at = first + size;
    }
    require(chunks.json.is_object(), "no JSON chunk");
    return chunks;
}

size_t componentSize(int type) {
    switch (type) {
    case 5121: return 1;
    case 5123: return 2;
    case 5125:
    case kFloat: return 4;
    default: throw std::runtime_error("GLB: component type " + std::to_string(type) + " is not read");
    }
}

size_t componentCount(const std::string& type) {
    if (type == "SCALAR") return 1;
    require(type.size() == 4 && type.starts_with("VEC"), "accessor type " + type + " is not read");
    return static_cast<size_t>(type[3] - '0');
}

// The accessor's numbers, whatever their type, in rows of its component count.
std::vector<double> readAccessor(const Chunks& glb, const Json& index) {
    const Json& accessor = glb.json.at("accessors").at(index.get<size_t>());
    const Json& view = glb.json.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
    const int type = accessor.at("componentType").get<int>();
    const size_t size = componentSize(type), width = componentCount(accessor.at("type").get<std::string>());
    const size_t count = accessor.at("count").get<size_t>(), stride = view.value("byteStride", size * width);
    const size_t first = view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0});
    require(count > 0, "an empty accessor");
    require(first + (count - 1) * stride + size * width <= glb.binary.size(), "an accessor runs past the buffer");
    std::vector<double> numbers;
    numbers.reserve(count * width);
    for (size_t k = 0; k < count * width; ++k) {
        const char* from = glb.binary.data() + first + k / width * stride + k % width * size;
        float real = 0;
        uint32_t whole = 0;
        if (type == kFloat)
            std::memcpy(&real, from, size);
        else
            std::memcpy(&whole, from, size);
        numbers.push_back(type == kFloat ? static_cast<double>(real) : static_cast<double>(whole));
    }
    return numbers;
}

Point row(const std::vector<double>& numbers, size_t k) {
    require(3 * k + 2 < numbers.size(), "an index past the last vertex");
    return {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
}

Point pointOf(const Json& list) {
    require(list.is_array() && list.size() == 3, "three numbers expected");
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

class Reader {
public:
    explicit Reader(Chunks chunks) : glb_(std::move(chunks)) {}
    FragmentFile read();

private:
    void fault(const std::string& where, const std::string& what) { file_.faults.push_back(where + ": " + what); }
    Piece readPiece(const Json& node);
    void readPrimitive(const Json& primitive, Piece& piece);
    void checkNormals(const Triangles& triangles, const std::vector<Point>& normals, bool flat, const std::string& name);
    void checkBounds(const Json& primitive, const std::vector<double>& positions, const std::string& name);

    Chunks glb_;
    FragmentFile file_;
};

FragmentFile Reader::read() {
    const Json& json = glb_.json;
    require(json.contains("nodes") && !json["nodes"].empty(), "no nodes");
    for (const Json& node : json["nodes"]) {
        if (!node.contains("mesh")) continue;
        char expected[32];
        std::snprintf(expected, sizeof expected, "fragment_%04zu", file_.pieces.size());
        file_.pieces.push_back(readPiece(node));
        if (file_.pieces.back().name != expected) fault(file_.pieces.back().name, std::string("expected the name ") + expected);
    }
    require(!file_.pieces.empty(), "no fragment");
    return std::move(file_);
}

Piece Reader::readPiece(const Json& node) {
    Piece piece;
    piece.name = node.value("name", "");
    for (const char* moved : {"rotation", "scale", "matrix"})
        if (node.contains(moved)) fault(piece.name, std::string("unexpected ") + moved);
    if (node.contains("translation")) piece.translation = pointOf(node["translation"]);
    const Json& extras = node.at("extras");
    piece.site = pointOf(extras.at("site"));
    piece.cell = extras.at("cell").get<uint32_t>();
    piece.volume = extras.at("volume").get<double>();
    const Json& mesh = glb_.json.at("meshes").at(node["mesh"].get<size_t>());
    for (const Json& primitive : mesh.at("primitives"))
        readPrimitive(primitive, piece);
    return piece;
}

void Reader::readPrimitive(const Json& primitive, Piece& piece) {
    require(primitive.value("mode", kTriangles) == kTriangles, "a primitive that is not triangles");
    const Json& material = glb_.json.at("materials").at(primitive.at("material").get<size_t>());
    const std::string name = material.value("name", "");
    require(name == "outer" || name == "inner", "a material named \"" + name + "\"");

    const Json& attributes = primitive.at("attributes");
    const std::vector<double> positions = readAccessor(glb_, attributes.at("POSITION"));
    const std::vector<double> normals = readAccessor(glb_, attributes.at("NORMAL"));
    const std::vector<double> uvs = readAccessor(glb_, attributes.at("TEXCOORD_0"));
    if (normals.size() != positions.size() || uvs.size() / 2 != positions.size() / 3)
        fault(piece.name, "attributes of different lengths");
    checkBounds(primitive, positions, piece.name);

    const std::vector<double> indices = readAccessor(glb_, primitive.at("indices"));
    require(indices.size() % 3 == 0, "indices that are not triangles");
    Triangles triangles;
    std::vector<Point> corner_normals;
    for (size_t k = 0; k < indices.size(); ++k) {
        if (k % 3 == 0) triangles.emplace_back();
        triangles.back()[k % 3] = row(positions, static_cast<size_t>(indices[k]));
        corner_normals.push_back(row(normals, static_cast<size_t>(indices[k])));
    }
    checkNormals(triangles, corner_normals, name == "inner", piece.name);
    Triangles& side = name == "outer" ? piece.outer : piece.inner;
    side.insert(side.end(), triangles.begin(), triangles.end());
}

// Unit length everywhere; on cut faces the triangle's own normal, wherever the triangle is fat enough to have one in floats.
void Reader::checkNormals(const Triangles& triangles, const std::vector<Point>& normals, bool flat, const std::string& name) {
    size_t not_unit = 0, turned = 0;
    for (size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t];
        const Point across = cross(b - a, c - a);
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        const double size = std::max({length(a), length(b), length(c)});
        const bool fat = length(across) > 1e-4 * longest * size && length(across) > 1e-2 * longest * longest;
        for (size_t k = 0; k < 3; ++k) {
            const Point& normal = normals[3 * t + k];
            not_unit += !(std::abs(length(normal) - 1) < 1e-3);
            turned += flat && fat && !(dot(normal, across) > 0.98 * length(across));
        }
    }
    if (not_unit > 0) fault(name, std::to_string(not_unit) + " normals that are not of unit length");
    if (turned > 0) fault(name, std::to_string(turned) + " normals of cut faces that are not the triangle's");
}

void Reader::checkBounds(const Json& primitive, const std::vector<double>& positions, const std::string& name) {
    const Json& accessor = glb_.json.at("accessors").at(primitive.at("attributes").at("POSITION").get<size_t>());
    if (!accessor.contains("min") || !accessor.contains("max")) return fault(name, "positions without min and max");
    Bounds bounds;
    for (size_t k = 0; k < positions.size() / 3; ++k)
        bounds.grow(row(positions, k));
    if (pointOf(accessor["min"]) != bounds.lower || pointOf(accessor["max"]) != bounds.upper)
        fault(name, "min and max are not those of the positions");
}

} // namespace

FragmentFile readFragmentFile(const std::string& path) { return Reader(readChunks(path)).read(); }

} // namespace reference
