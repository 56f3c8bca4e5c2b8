// The predicates of fracture, from their definitions: determinants of whole numbers, and ties by weights.
//
// Every predicate is linear in the weights of the sites. So its value at zero weights and at one unit weight at a time gives
// all its coefficients, and its sign under weights eps^(id + 1) is the sign of the first of them that is not 0.
#pragma once

#include "tests/reference/big_int.h"
#include "tests/reference/voronoi.h"

#include <array>
#include <cstdint>
#include <optional>

namespace reference {

struct Site {
    GridPoint at;
    uint32_t id;
};

// A plane of a cell: the bisector with a site, or an axis plane (a wall of the box) at a coordinate.
struct CellPlane {
    enum class Kind { Bisector, LowerWall, UpperWall } kind = Kind::Bisector;
    Site site = {};         // of a bisector
    uint32_t axis = 0;      // of a wall
    int32_t coordinate = 0; // of a wall
};

// Orientation of three planes' normals: 0 where they do not meet in a point.
int planesTurn(const Site& self, const std::array<CellPlane, 3>& planes);
// Does the bisector with `cutter` cut away the corner of three planes (whose turn is not 0) from the cell of `self`?
bool cutsCorner(const Site& self, const std::array<CellPlane, 3>& planes, const Site& cutter);

// |p - site|^2 - |p - self|^2: how much nearer p is to self.
int64_t nearness(const GridPoint& self, const GridPoint& site, const GridPoint& p);

// On the segment from a to b, at the place where self and j are equally near: is that place nearer to self (1) or to l (-1)?
// Nothing where the segment runs along the bisector, so that there is no such place.
std::optional<int> edgeSign(const Site& self, const Site& j, const Site& l, const GridPoint& a, const GridPoint& b);

// A line in a triangle's plane: the bisector of self with a site, or one of the triangle's edges (k joins corners k, k + 1).
struct TriangleLine {
    std::optional<uint32_t> edge;
    Site site = {};
};

// At the point where two lines of the triangle cross: is it nearer to self (1) or to l (-1)? Nothing where they do not cross.
std::optional<int> triangleSign(const Site& self, const std::array<TriangleLine, 2>& lines, const Site& l,
                                const std::array<GridPoint, 3>& triangle);

} // namespace reference
