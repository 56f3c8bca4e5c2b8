// Checks on the host, in double, that fragments keep their contract: closed, connected, of positive volume, cut faces shared
// bit for bit, adding up to the model, each within its own cell. Reads nothing but the outcome.
#pragma once

#include "modules/brittle/fracture/fragments.h"

#include <span>
#include <string>

namespace brittle {

struct ContractReport {
    uint64_t open_edges = 0;               // by position: not walked as often one way as the other
    uint64_t unpaired_inner_triangles = 0; // without their mirror image in another fragment
    uint64_t turned_inner_triangles = 0;   // that do not face the fragment behind them, by more than rounding explains
    uint32_t hollow_fragments = 0;         // whose volume is not positive
    uint32_t parted_fragments = 0; // with more or less than one outer surface; walls of cavities do not count, however thin
    double volume_error = 0;       // |sum of fragments - model| / model
    double area_error = 0;         // the same for outer triangles
    double centroid_error = 0;     // of all fragments together, as a share of the diagonal
    double outside_cell = 0;       // furthest vertex beyond its cell, as a share of the diagonal

    // The first broken promise, with what was measured and what is allowed; empty where the contract holds.
    std::string violation() const;
    bool holds() const { return violation().empty(); }
};

constexpr double kMaxVolumeError = 1e-6, kMaxAreaError = 1e-5, kMaxCentroidError = 1e-6, kMaxOutsideCell = 1e-5;

// `sites` are those that Fragment::cell points into, in model space.
ContractReport verifyContract(const Mesh& mesh, const MeshMeasures& measures, const FragmentSet& fragments,
                              std::span<const Double3> sites);

} // namespace brittle
