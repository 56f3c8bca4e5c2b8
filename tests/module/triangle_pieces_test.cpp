// Which sides of the triangles of a fixed surface are hidden.
#include "modules/brittle/dynamics/triangle_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brittle::Double3, brittle::ImportedMesh, brittle::PieceShape;

// Bit v stands for the side that vertex v is not on.
std::vector<uint32_t> hiddenSides(const std::vector<Double3>& places, const std::vector<std::array<uint32_t, 3>>& triangles) {
    ImportedMesh mesh;
    mesh.positions = places;
    for (const auto& t : triangles)
        mesh.triangles.push_back({t[0], t[1], t[2]});
    std::vector<uint32_t> hidden;
    for (const PieceShape& piece : brittle::trianglePieces(mesh))
        hidden.push_back(piece.hidden_sides);
    return hidden;
}

// The second triangle is turned by `degrees` about the diagonal from vertex 1 to vertex 2.
std::vector<Double3> square(double degrees) {
    const double angle = degrees * std::acos(-1) / 180, half = std::sqrt(0.5);
    return {
        {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::cos(angle), half * std::sin(angle)}};
}

TEST(TrianglePieces, HideTheDiagonalOfASquare) {
    EXPECT_EQ(hiddenSides(square(0), {{0, 1, 2}, {1, 3, 2}}), (std::vector<uint32_t>{1, 2}));
}

TEST(TrianglePieces, HideSidesOfTrianglesThatLookTheOtherWay) {
    EXPECT_EQ(hiddenSides(square(0), {{0, 1, 2}, {2, 3, 1}}), (std::vector<uint32_t>{1, 2}));
}

TEST(TrianglePieces, HideNoSideAtAnEdge) {
    EXPECT_EQ(hiddenSides(square(4), {{0, 1, 2}, {1, 3, 2}}), (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(hiddenSides(square(6), {{0, 1, 2}, {1, 3, 2}}), (std::vector<uint32_t>{0, 0}));
    EXPECT_EQ(hiddenSides(square(-90), {{0, 1, 2}, {1, 3, 2}}), (std::vector<uint32_t>{0, 0}));
    EXPECT_EQ(hiddenSides(square(180), {{0, 1, 2}, {1, 3, 2}}), (std::vector<uint32_t>{0, 0})) << "they lie on each other";
}

TEST(TrianglePieces, FindNeighborsByPlaces) {
    std::vector<Double3> places = square(0);
    places.insert(places.end(), {places[1], places[2]});
    EXPECT_EQ(hiddenSides(places, {{0, 1, 2}, {4, 3, 5}}), (std::vector<uint32_t>{1, 2}));
}

TEST(TrianglePieces, LeaveOutWhatHasNoArea) {
    EXPECT_EQ(hiddenSides(square(0), {{0, 1, 1}, {0, 1, 2}}), (std::vector<uint32_t>{0}));
}

} // namespace
