#include "modules/brittle/dynamics/triangle_pieces.h"

#include "modules/brittle/mesh/vector_math.h"

#include <array>
#include <cmath>
#include <map>

namespace brittle {
namespace {

constexpr double kLevel = 0.9962; // cosine of five degrees

using Side = std::array<Float3, 2>; // the lower corner first

Double3 normalOf(const PieceShape& piece) {
    const Double3 base = toDouble(piece.vertices[0]);
    return cross(toDouble(piece.vertices[1]) - base, toDouble(piece.vertices[2]) - base);
}

// The side that a vertex is not on, and whether the triangle runs along it from the lower to the higher corner.
std::pair<Side, bool> sideOf(const PieceShape& piece, size_t vertex) {
    const Float3 &from = piece.vertices[(vertex + 1) % 3], &to = piece.vertices[(vertex + 2) % 3];
    return from < to ? std::pair{Side{from, to}, true} : std::pair{Side{to, from}, false};
}

struct Neighbor {
    size_t piece;
    bool runs_up;
};

void hideSides(std::vector<PieceShape>& pieces) {
    std::map<Side, std::vector<Neighbor>> sides;
    for (size_t k = 0; k < pieces.size(); ++k)
        for (size_t v = 0; v < 3; ++v) {
            const auto [side, runs_up] = sideOf(pieces[k], v);
            sides[side].push_back({k, runs_up});
        }
    std::vector<Double3> normals;
    for (const PieceShape& piece : pieces)
        normals.push_back(normalized(normalOf(piece), {0, 0, 0}));
    for (size_t k = 0; k < pieces.size(); ++k)
        for (size_t v = 0; v < 3; ++v) {
            const auto [side, runs_up] = sideOf(pieces[k], v);
            for (const Neighbor& other : sides[side]) {
                const double cosine = dot(normals[k], normals[other.piece]) * (other.runs_up == runs_up ? -1 : 1);
                if (other.piece != k && cosine >= kLevel) pieces[k].hidden_sides |= 1u << v;
            }
        }
}

} // namespace

std::vector<PieceShape> trianglePieces(const ImportedMesh& surface) {
    std::vector<PieceShape> pieces;
    for (const Index3& t : surface.triangles) {
        PieceShape piece;
        for (const uint32_t v : t)
            piece.vertices.push_back(toFloat(surface.positions[v]));
        if (length(normalOf(piece)) == 0) continue;
        piece.loops = {{0, 1, 2}, {2, 1, 0}};
        pieces.push_back(std::move(piece));
    }
    hideSides(pieces);
    return pieces;
}

} // namespace brittle
