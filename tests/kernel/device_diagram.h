// Cells cut, packed and linked on the device, read back as the later kernels see them.
#pragma once

#include "tests/kernel/device_cells.h"

namespace kernel_test {

struct DeviceDiagram {
    std::vector<Word4> cell_offsets; // of each cell, and the end: neighbors, corners, vertices and edges that it owns
    std::vector<uint32_t> neighbors;
    std::vector<Word4> corners;     // three sites in cyclic order, and the Voronoi vertex or NO_INDEX
    std::vector<Word2> corner_info; // cell, first edge
    std::vector<Word4> vertex_sites, edge_sites;
    std::vector<uint32_t> face_cells;
    std::vector<Word2> edge_ends; // vertices, or NO_INDEX where the edge leaves the box
};

DeviceDiagram diagramOnDevice(const reference::SiteSet& set);

} // namespace kernel_test
