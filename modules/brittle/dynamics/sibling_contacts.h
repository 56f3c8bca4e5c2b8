// Fresh fragments touch where their cells do: what a fracture knows of neighbors are the contacts of the first step, and the
// narrow phase has nothing to find.
#pragma once

#include "modules/brittle/collision/collider.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "modules/brittle/fracture/fragments.h"
#include "shaders-spirv/shared/solver.h"

namespace brittle {

// Where the pieces of two fragments share a face: up to four corners of what their two sides of it have in common, in the unit
// of the pieces, from the middle of what was broken. Pieces of cells that hold more than one fragment are left out.
struct SharedFace {
    uint32_t a = 0, b = 0;      // fragments, a < b
    Double3 normal = {0, 0, 0}; // from a to b, unit
    std::vector<Double3> points;
};
std::vector<SharedFace> sharedFaces(const FragmentSet& set);

// What a world remembers of the contacts of its siblings before its first step, in the order of their pairs of pieces.
struct FirstContacts {
    std::vector<std::array<uint32_t, 2>> pairs;
    std::vector<gpu::ContactMemory> contacts;
};
FirstContacts firstContacts(const WorldContents& contents);

} // namespace brittle
