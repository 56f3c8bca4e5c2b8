// Finds where a surface passes through itself.
//
// Two triangles that cross are measured by how deep they do: the length of the shortest shift that parts them. It is the
// smallest overlap of their shadows over the directions across both (their two normals and the products of their edges), the
// separating-axis test read as a distance. That needs no exact arithmetic: a direction a little off still gives an honest
// overlap along itself, and what doubles round away is ten digits below the depths that matter.
#pragma once

#include "modules/brittle/mesh/triangle_shape.h"
#include "modules/brittle/mesh/triangle_tree.h"

namespace brittle {

// Triangles that cross by less than this share of the diagonal only touch. All checks and repairs take touching to mean this.
constexpr double kTouchDepth = 1e-6;
// Depths below this share of the diagonal are not told from 0: positions are floats, of 24 bits.
constexpr double kNoiseDepth = 1e-9;

struct Crossing {
    uint32_t first = 0, second = 0; // triangles
    double depth = 0;               // in model units
    Double3 where = {0, 0, 0};      // relative to the mesh's center
};

struct SelfIntersection {
    uint32_t crossing_pairs = 0;     // counting stops at kMaxCrossings
    uint32_t touching_pairs = 0;     // cross by less than kTouchDepth: rounding, not a fault
    Crossing deepest;                // of all, also those that touch
    std::vector<Crossing> crossings; // the crossing pairs
    bool gave_up = false;            // after kMaxPairTests pairs of triangles whose boxes touch
};

constexpr uint32_t kMaxCrossings = 10'000;
// What is tested is linear in the size of a surface that has room; a heap of triangles in one place must not take for ever.
constexpr uint64_t kMaxPairTests = 500'000'000;

// 0 where the triangles do not cross. What is no deeper than `floor` counts as 0 too and is found sooner.
double penetrationDepth(const Corners& a, const Corners& b, double floor = 0);

SelfIntersection findSelfIntersections(const Mesh& mesh, const TriangleTree& tree, double diagonal);

} // namespace brittle
