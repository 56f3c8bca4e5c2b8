// Which side of a surface is its front.
#pragma once

#include "modules/brittle/mesh/half_edge.h"

namespace brittle {

// Parts are what hangs together by edges of two triangles. Sheets that meet at edges of more count as one part where one of
// them would not close without the others there.
struct Orientation {
    std::vector<uint32_t> part; // of every triangle
    std::vector<char> turn;     // of every triangle: it disagrees with the larger half of its part
    std::vector<uint32_t> torn; // edges across which no turning makes the two agree: the surface has one side only
    uint32_t part_count = 0;
};

Orientation findOrientation(const Mesh& mesh, const EdgeUses& uses);

struct TurnedPart {
    Double3 where = {0, 0, 0}; // in the middle of its largest triangle, relative to the mesh's center
    bool is_hollow = false;
    double added_volume = 0; // to that of the whole mesh
};

// Turns the parts of a closed, consistently oriented mesh so that each has its solid behind it: outward, or inward for one
// that lies inside an odd number of others. Returns those that were turned.
std::vector<TurnedPart> turnOutward(Mesh& mesh);

} // namespace brittle
