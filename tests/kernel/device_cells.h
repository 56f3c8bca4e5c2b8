// Runs the cell kernels on a set of sites and reads their cells back in the oracle's terms.
#pragma once

#include "modules/brittle/fracture/precision.h"
#include "tests/kernel/lab.h"
#include "tests/reference/voronoi.h"

#include <vector>

namespace kernel_test {

// The sites sorted into cubic bins over the box, as the kernels search them.
struct BinnedSites {
    Int4 bins = {1, 1, 1, 1};           // per axis; the last is a bin's edge
    std::vector<Int4> sites, bin_sites; // by id; bin by bin with the id last
    std::vector<uint32_t> bin_start;
};
BinnedSites binSites(const reference::SiteSet& set);

enum class Path {
    Filtered,       // as in a fracture: fp32 first, what is not certain again in integers
    FilteredLinear, // the same, with neighbors looked for otherwise
    FilteredTree,
    FilteredEdges, // the same with a workgroup a cell and a lane an edge
    Exact          // in integers from the start
};

struct DeviceCells {
    std::vector<reference::VoronoiCell> cells; // site, neighbors and vertices
    uint32_t unfinished = 0;                   // cells whose status is not CELL_OK
    uint32_t undecided = 0;                    // left over by the filter
    uint32_t redone = 0;                       // with more room
};
// Raw cells on the device, as count_cells reads them.
struct RawCells {
    engine::Buffer raw, at; // words; where each cell begins among them, and its size class
    uint32_t undecided = 0, redone = 0;
};
RawCells cutRaw(const reference::SiteSet& set, Path path = Path::Filtered,
                brittle::Precision precision = brittle::Precision::Exact);

DeviceCells cutOnDevice(const reference::SiteSet& set, Path path = Path::Filtered,
                        brittle::Precision precision = brittle::Precision::Exact);

} // namespace kernel_test
