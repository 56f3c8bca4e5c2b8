// The libraries the bench runs beside us. Each gets the same sites and the same model, and runs on one thread.
#pragma once

#include "tools/bench/inputs.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bench {

struct PeerCells {
    double ms = 0; // filling the container and computing every cell with its neighbors
    uint64_t cells = 0;
    uint64_t faces = 0;
};

// Sites in the unit box. Nothing where Voro++ is not in the build.
std::optional<PeerCells> voroppCells(std::span<const Point> sites);

// The corners of every cell of the unit box, for peers that only cut. Empty where Voro++ is not in the build.
std::vector<std::vector<Point>> cellCorners(std::span<const Point> sites);

struct PeerShatter {
    double ms = 0; // the hull of every cell and its intersection with the model; finding the cells is not counted
    uint32_t fragments = 0;
    uint32_t failures = 0;
    double volume_error = 0; // |sum of fragments - model| / model
};

// CGAL is a program of its own, brittle_peer_cgal, beside this one: it is slow to build, and nothing of it is linked into
// `brittle`. Nothing where that program is not there.
std::optional<PeerShatter> cgalShatter(uint32_t level, uint32_t site_count, uint64_t seed);

} // namespace bench
