// What the fragments of a model should be, in double precision and by brute force (tests/reference), and how far they are off.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "tests/reference/clipped_cells.h"
#include "tools/accuracy/results.h"

namespace accuracy {

struct FractureTruth {
    reference::Triangles model; // model space
    std::vector<reference::Point> sites;
    std::vector<reference::Polyhedron> cells; // of a convex model its fragments, else its cells within its box
    std::vector<double> volumes;              // of the model in each cell
    double volume = 0, diagonal = 0;
    double defect = 0; // of the reference itself: by how much its volumes do not add up to the model's, as a share
    bool is_convex = false;
};

FractureTruth truthOf(const brittle::Mesh& mesh, std::span<const brittle::Double3> sites);

namespace kinds {
extern const ErrorKind kVolume, kArea, kCellVolume, kCorners, kPromises, kNeighbors, kTurned;
}

// Of all kinds that the model allows.
std::vector<MeasuredError> errorsOf(const FractureTruth& truth, const brittle::FractureResult& result);

} // namespace accuracy
