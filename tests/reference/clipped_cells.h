// Voronoi cells in double precision, by holding every site against every other, and what of a model lies in each: the truth
// that fragments are measured against, where the exact diagram of voronoi.h would say more about ties than about size.
//
// A cell is a box that is cut by half-spaces, face by face. Nothing is decided: two faces that tie leave a face without area,
// which counts for nothing.
#pragma once

#include "tests/reference/geometry.h"

#include <span>
#include <vector>

namespace reference {

constexpr uint32_t kWallId = 0xffffff00;  // of the box: + 0 .. 5 = -x, +x, -y, +y, -z, +z
constexpr uint32_t kModelId = 0xfffffeff; // of the model's own faces, all of them

struct PolyhedronFace {
    uint32_t id = 0;         // the site on its other side, or what else it is cut by
    std::vector<Point> loop; // counter-clockwise seen from outside
};

struct Polyhedron {
    std::vector<PolyhedronFace> faces; // none: nothing is left
};

Polyhedron boxOf(const Bounds& bounds);
// Keeps what lies at normal . x <= height; the new face gets the id.
void cut(Polyhedron& solid, const Point& normal, double height, uint32_t id);

double volumeOf(const Polyhedron& solid);
double areaOf(const PolyhedronFace& face);

// One a site, in their order. Sites are distinct.
std::vector<Polyhedron> voronoiCells(std::span<const Point> sites, const Bounds& box);
// The same, cut by every plane of a convex model.
std::vector<Polyhedron> cellsOfConvex(std::span<const Point> sites, std::span<const Triangle> model);

// How much of a closed model, convex or not, lies in each cell. The model is the sum of the tetrahedra from its center to every
// triangle, each with the sign of its own volume, and a tetrahedron is cut as any convex solid is.
std::vector<double> volumesWithin(std::span<const Triangle> model, std::span<const Polyhedron> cells);

// To the nearest point of the triangle.
double distanceTo(const Triangle& triangle, const Point& p);

} // namespace reference
