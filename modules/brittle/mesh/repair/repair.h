// Mends what is well defined and refuses the rest.
//
// The steps, in this order, each of them on its own ground:
//   seams       vertices of open edges that are one but for rounding are joined; split edges (T-junctions) are split on both
//               sides; triangles without area that close nothing are dropped
//   doubles     of triangles with the same three corners one stays; two layers of wall between solids that touch both go
//   orientation neighbors are made to agree, from triangle to triangle
//   holes       small ones are closed
//   inside out  every part faces outward, or inward where it is the wall of a hollow in another
// What comes out has passed the same check as every other model. A surface that cannot be made a solid by these steps alone is
// refused: there is no guessing. A repair that changes the volume by more than its notes account for is refused as well.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/prepare.h"

#include <string>

namespace brittle {

// The limits, all of them. Shares are of the diagonal of the model's box.
constexpr double kSeamWidth = 1e-5;      // vertices this near are one, if all others are four times as far
constexpr double kJunctionWidth = 1e-6;  // a vertex this near to an open edge lies on it
constexpr size_t kFewHoleEdges = 16;     // a hole of no more edges is closed whatever its size,
constexpr size_t kMaxHoleEdges = 200;    // one of no more than these
constexpr double kMaxHoleDiameter = 0.1; // if its box is no larger than this
constexpr double kMaxHoleShare = 0.75;   // and in any case if its filling has no more of this share of its part's area:
                                         // what is shallower is a sheet, which has no inside to be closed off

// What was mended, and where (model space).
struct RepairNotes {
    std::vector<Double3> joined_vertices, split_edges, dropped_flat, dropped_doubles;
    std::vector<Double3> turned_triangles;      // that disagreed with the rest of their part
    std::vector<Double3> turned_parts;          // that faced inward
    std::vector<Double3> turned_hollows;        // parts inside others that faced outward
    double volume_before = 0, volume_after = 0; // of the closed surface, before and after parts were turned
    struct Hole {
        uint32_t edges = 0;
        double diameter = 0; // of its box
        Double3 where = {0, 0, 0};
    };
    std::vector<Hole> closed_holes;

    bool isEmpty() const { return text().empty(); }
    // In one line; empty for none.
    std::string text() const;
};

struct RepairedMesh {
    PreparedMesh model; // sound
    RepairNotes notes;  // empty: it was sound already, and is what prepareMesh makes of it
};

// BadInput, in one line with what, where and what to do, for whatever is still unsound afterwards.
engine::Result<RepairedMesh> repairMesh(const ImportedMesh& imported);

} // namespace brittle
