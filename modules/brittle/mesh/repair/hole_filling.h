// Closes holes, each with triangles between the vertices of its rim.
//
// After Liepa, "Filling Holes in Meshes" (2003), section 3: of all triangulations of the rim the one whose sharpest fold, also
// against the surface around, is the least; here of those that fold about the same the one with the shortest sides. So a hole
// in a plane is closed in the plane, whatever its outline, and one in a rounded surface without a crease.
#pragma once

#include "modules/brittle/mesh/repair/repair.h"

namespace brittle {

struct HoleFilling {
    std::vector<RepairNotes::Hole> closed; // `where` is relative to the mesh's center
    struct Left {
        RepairNotes::Hole hole;
        const char* why = nullptr;
    };
    std::vector<Left> left;
};

// Within the limits of repair.h. The mesh must be consistently oriented; no new edge doubles one that is there.
HoleFilling fillHoles(Mesh& mesh, double diagonal);

} // namespace brittle
