#include "modules/brittle/dynamics/triangle_pieces.h"

#include "modules/brittle/mesh/vector_math.h"

#include <algorithm>
#include <array>
#include <span>

namespace brittle {
namespace {

constexpr double kLevel = 0.9962; // cosine of five degrees

Double3 normalOf(const PieceShape& piece) {
    const Double3 base = toDouble(piece.vertices[0]);
    return cross(toDouble(piece.vertices[1]) - base, toDouble(piece.vertices[2]) - base);
}

// A side of a triangle: the one that `vertex` is not on.
struct Side {
    std::array<Float3, 2> ends; // the lower one first
    bool runs_up;               // the triangle runs along it from the lower to the higher end
    size_t piece, vertex;
    Double3 normal; // unit, of the triangle
};

Side sideOf(const std::vector<PieceShape>& pieces, size_t piece, size_t vertex, const Double3& normal) {
    const auto& corners = pieces[piece].vertices;
    const Float3 &from = corners[(vertex + 1) % 3], &to = corners[(vertex + 2) % 3];
    const bool runs_up = from < to;
    return {{runs_up ? from : to, runs_up ? to : from}, runs_up, piece, vertex, normal};
}

// Sides with the same ends come one after the other.
std::vector<Side> sortedSides(const std::vector<PieceShape>& pieces) {
    std::vector<Side> sides;
    for (size_t piece = 0; piece < pieces.size(); ++piece) {
        const Double3 normal = normalized(normalOf(pieces[piece]), {0, 0, 0});
        for (size_t vertex = 0; vertex < 3; ++vertex)
            sides.push_back(sideOf(pieces, piece, vertex, normal));
    }
    std::ranges::sort(sides, {}, &Side::ends);
    return sides;
}

// `sides` have the same ends.
void hideLevelSides(std::vector<PieceShape>& pieces, std::span<const Side> sides) {
    for (const Side& side : sides)
        for (const Side& other : sides) {
            if (side.piece == other.piece) continue;
            const double cosine = dot(side.normal, other.normal);
            if ((side.runs_up == other.runs_up ? -cosine : cosine) >= kLevel)
                pieces[side.piece].hidden_sides |= 1u << side.vertex;
        }
}

void hideSides(std::vector<PieceShape>& pieces) {
    const std::vector<Side> sides = sortedSides(pieces);
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if(first, sides.end(), [&](const Side& side) { return side.ends != first->ends; });
        hideLevelSides(pieces, {first, last});
        first = last;
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
