// How the work of cutting cells is spread over the device. All ways give the same cells; they differ in time.
#pragma once

#include <cstdint>

namespace brittle {

enum class CellMapping : uint8_t {
    Auto,  // lanes
    Lanes, // a lane a cell
    Edges, // a workgroup a cell, a lane an edge: the paper's (section 3); finds neighbors by grid only
};

} // namespace brittle
