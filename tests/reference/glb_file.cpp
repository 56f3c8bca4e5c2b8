#include "tests/reference/glb_file.h"

#include "tests/reference/glb_chunks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace reference {
namespace {

using Json = nlohmann::json;

constexpr int kTriangles = 4;

class Reader {
public:
    explicit Reader(GlbChunks chunks) : glb_(std::move(chunks)) {}
    FragmentFile read();

private:
    void fault(const std::string& where, const std::string& what) { file_.faults.push_back(where + ": " + what); }
    Piece readPiece(const Json& node);
    void readPrimitive(const Json& primitive, Piece& piece);
    void checkNormals(const Triangles& triangles, const std::vector<Point>& normals, bool flat, const std::string& name);
    void checkBounds(const Json& primitive, const std::vector<double>& positions, const std::string& name);

    GlbChunks glb_;
    FragmentFile file_;
};

FragmentFile Reader::read() {
    const Json& json = glb_.json;
    requireGlb(json.contains("nodes") && !json["nodes"].empty(), "no nodes");
    for (const Json& node : json["nodes"]) {
        if (!node.contains("mesh")) continue;
        char expected[32];
        std::snprintf(expected, sizeof expected, "fragment_%04zu", file_.pieces.size());
        file_.pieces.push_back(readPiece(node));
        if (file_.pieces.back().name != expected) fault(file_.pieces.back().name, std::string("expected the name ") + expected);
    }
    requireGlb(!file_.pieces.empty(), "no fragment");
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
    requireGlb(primitive.value("mode", kTriangles) == kTriangles, "a primitive that is not triangles");
    const Json& material = glb_.json.at("materials").at(primitive.at("material").get<size_t>());
    const std::string name = material.value("name", "");
    requireGlb(name == "outer" || name == "inner", "a material named \"" + name + "\"");

    const Json& attributes = primitive.at("attributes");
    const std::vector<double> positions = readAccessor(glb_, attributes.at("POSITION"));
    const std::vector<double> normals = readAccessor(glb_, attributes.at("NORMAL"));
    const std::vector<double> uvs = readAccessor(glb_, attributes.at("TEXCOORD_0"));
    if (normals.size() != positions.size() || uvs.size() / 2 != positions.size() / 3)
        fault(piece.name, "attributes of different lengths");
    checkBounds(primitive, positions, piece.name);

    const std::vector<double> indices = readAccessor(glb_, primitive.at("indices"));
    requireGlb(indices.size() % 3 == 0, "indices that are not triangles");
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

FragmentFile readFragmentFile(const std::string& path) { return Reader(readGlbChunks(path)).read(); }

} // namespace reference
