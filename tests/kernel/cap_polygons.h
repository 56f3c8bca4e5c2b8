// Polygons made by hand, laid into a bisector as cap_intervals and cap_cuts would have left them, and the triangles that the
// cap kernels make of them.
#pragma once

#include "tests/kernel/lab.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace kernel_test {

using CapPoint = std::array<int32_t, 2>;
using CapLoop = std::vector<CapPoint>; // counter-clockwise; holes clockwise
using Grid3 = std::array<int32_t, 3>;

struct CapPolygon {
    std::vector<CapPoint> points;    // each place once
    std::vector<Word2> segments;     // between points
    std::optional<size_t> triangles; // how many there must be
    bool may_be_flat = false;        // triangles without area are no mistake
    int32_t per_step = 1;            // points are in such parts of a grid step
    uint32_t flat_from = NO_INDEX;   // segments from here on are outlines of mesh faces in the bisector
    int64_t crosses = 0;             // itself, by so many of them: triangles may be turned over by as much
};
CapPolygon polygonOf(const std::vector<CapLoop>& loops);

// Where a plane's x and y point on the grid, and the way from the lower cell's site to the other's, which is their cross
// product but for its length.
struct CapBasis {
    Grid3 x, y, normal;
};
extern const std::vector<CapBasis> kCapBases;

enum class Through { AllInTurn, Large, Huge, Vast, Convex };

struct CapRun {
    std::vector<std::vector<Grid3>> triangles;        // of each polygon: three of its points
    uint32_t wide = 0, large = 0, huge = 0, vast = 0; // faces passed on: to cap_fans, and from there
    uint32_t bad = 0, turned_over = 0, collapsed = 0;
};
CapRun capOnDevice(const std::vector<CapPolygon>& polygons, const CapBasis& basis, Through through);

void expectTriangulated(const CapPolygon& polygon, const std::vector<Grid3>& triangles);

} // namespace kernel_test
