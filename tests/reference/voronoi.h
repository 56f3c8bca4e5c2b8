// Voronoi cells of integer sites in an integer box, by brute force and exactly: the answer the kernels have to match.
//
// A cell starts as the box and is cut by the bisector of every other site. Cell i lives in coordinates w = 2 (x - site_i), in
// which the bisector with site j is the half-space d . w <= |d|^2, d = site_j - site_i: integers all through. A corner is kept
// as the exact fraction numerator / denominator of its three planes, so that "does this bisector cut that corner" is one
// integer sign. With coordinates of 24 bits every value stays below 2^125.
//
// Ties are broken by simulation of simplicity: site s carries the weight eps^(s + 1), eps as small as one likes, and the power
// diagram of those weights is cut. The lower id has the larger weight and wins. The diagram so defined is simple (three faces
// at a corner, four cells at a vertex) and does not depend on the order of the cuts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace reference {

using GridPoint = std::array<int32_t, 3>;

struct GridBox {
    GridPoint lower = {0, 0, 0};
    GridPoint upper = {1, 1, 1};
};

// Distinct sites in the closed box. The six box planes have the ids N + 0 .. N + 5 = -x, +x, -y, +y, -z, +z.
struct SiteSet {
    GridBox box;
    std::vector<GridPoint> sites;
};

// A vertex is named by the four sites or box planes that meet there, ascending.
using VertexName = std::array<uint32_t, 4>;

struct CellFace {
    uint32_t neighbor = 0;
    std::vector<uint32_t> sides;                // the neighbors across its edges, counter-clockwise seen from outside
    std::vector<std::array<double, 3>> corners; // corner k lies between side k and side k + 1; relative to the site
};

struct VoronoiCell {
    uint32_t site = 0;
    std::vector<uint32_t> neighbors;  // ascending; box planes among them
    std::vector<VertexName> vertices; // ascending
    std::vector<CellFace> faces;      // in the order of `neighbors`
};

enum class Cutting {
    UntilSafe, // near sites first; stops when the next is further than twice the furthest corner, with a margin for rounding
    Everything // every site, in the order of ids
};

VoronoiCell cutCell(const SiteSet& set, uint32_t site, Cutting cutting = Cutting::UntilSafe);
std::vector<VoronoiCell> cutAllCells(const SiteSet& set, Cutting cutting = Cutting::UntilSafe);

double cellVolume(const VoronoiCell& cell);

// What makes a list of cells one diagram, whoever cut them. All counts of a sound diagram are 0.
struct DiagramAudit {
    uint32_t lost_cells = 0;        // no faces, or fewer than four
    uint32_t one_sided_faces = 0;   // i names j as its neighbor, j does not name i
    uint32_t disputed_vertices = 0; // a vertex that some, not all, of its sites have, or a name that lacks the site itself
    uint32_t broken_cells = 0;      // 2 (faces - 2) vertices are what Euler asks of a simple cell
    bool sound() const { return lost_cells + one_sided_faces + disputed_vertices + broken_cells == 0; }
};

// Only `site`, `neighbors` and `vertices` are read; the cells stand in the order of their sites.
DiagramAudit auditDiagram(const std::vector<VoronoiCell>& cells);

} // namespace reference
