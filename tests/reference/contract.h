// The fragment contract, checked from the outside: a file of fragments against the model it came from, in double precision.
#pragma once

#include "tests/reference/glb_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reference {

struct ContractLimits {
    double volume_error = 1e-6;   // of the model's volume
    double area_error = 1e-5;     // of the model's area
    double outside_cell = 1e-5;   // of the model's diagonal
    double collapsed = 5e-7;      // of the diagonal: distance of walls that may be those of a cavity, whichever is inside
    uint32_t random_points = 300; // in the model's box and, as many again, close to the fragments' faces
    uint64_t seed = 1;
    uint64_t bisector_tests = 200'000'000; // where vertices x sites are more, every so-many-th vertex is tested
};

struct ContractReport {
    uint64_t open_edges = 0;         // by position: an edge not walked as often one way as the other
    uint64_t unpaired_inner = 0;     // inner triangles without their mirror image in another fragment
    double volume_error = 0;         // |sum of fragments - model| / model
    double area_error = 0;           // outer triangles only
    double centroid_error = 0;       // of all fragments together, as a share of the diagonal
    uint32_t not_positive = 0;       // fragments of volume <= 0
    uint32_t claimed_volume_off = 0; // fragments whose volume in the file is not theirs
    uint32_t not_connected = 0;      // fragments with more or less than one outer surface
    double outside_cell = 0;         // furthest vertex beyond its cell, as a share of the diagonal
    uint32_t mixed_frames = 0;       // fragments whose translation differs from the first one's
    uint32_t mixed_sites = 0;        // fragments of one cell with different sites
    uint32_t points_tested = 0;
    uint32_t points_wrong = 0;         // in no fragment or several where the model is solid, or in any where it is not
    uint32_t points_misplaced = 0;     // in a fragment whose site is not the nearest
    std::vector<std::string> problems; // one line for everything past its limit; none: the contract holds
    bool holds() const { return problems.empty(); }
    // Edges, triangles, fragments and points that are not as they should be; sizes do not count.
    uint64_t brokenPromises() const {
        return open_edges + unpaired_inner + not_positive + not_connected + claimed_volume_off + points_wrong + points_misplaced;
    }
    std::string text() const;
};

ContractReport checkContract(const FragmentFile& file, const Triangles& model, const ContractLimits& limits = {});

} // namespace reference
