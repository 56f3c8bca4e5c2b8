// Plain geometry in double precision, each function the shortest way that is right.
#pragma once

#include "tests/reference/voronoi.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace reference {

using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>; // counter-clockwise seen from outside
using Triangles = std::vector<Triangle>;

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a);

struct Bounds {
    Point lower = {1e300, 1e300, 1e300};
    Point upper = {-1e300, -1e300, -1e300};
    void grow(const Point& p);
    bool holds(const Point& p, double margin = 0) const;
    Point center() const { return 0.5 * (lower + upper); }
    double diagonal() const { return length(upper - lower); }
};
Bounds boundsOf(std::span<const Triangle> triangles);

// Measures of a closed surface by the divergence theorem, about the center of its bounds so that distance costs no digits.
double volumeOf(std::span<const Triangle> triangles);
double areaOf(std::span<const Triangle> triangles);
Point centroidOf(std::span<const Triangle> triangles);

// How often the surface winds around the point: the sum of solid angles over 4 pi.
long double windingNumber(std::span<const Triangle> triangles, const Point& p);

// The site nearest to the point; of equally near ones the lowest id. Exact on the grid.
uint32_t nearestSite(std::span<const GridPoint> sites, const GridPoint& p);
uint32_t nearestSite(std::span<const Point> sites, const Point& p);

// By how much the point lies beyond the bisector of `own` that it passes furthest, 0 within its cell.
double distanceOutsideCell(std::span<const Point> sites, uint32_t own, const Point& p);

} // namespace reference
