// How a cell finds the sites that may cut it (the paper, section 4). All ways give the same cells; they differ in time.
#pragma once

#include <cstdint>

namespace brittle {

enum class Search : uint8_t {
    Auto,       // grid, but for sites that crowd: there the sphere tree
    Linear,     // all sites, through shared memory; refused above MOST_LINEAR_SITES
    SphereTree, // the paper's, figure 7
    Grid,       // bins of a few sites each
};

// Even sites put two into a bin, and hardly ever ten.
constexpr uint32_t kCrowdedBin = 40;

constexpr Search chosenSearch(Search asked, bool crowded) {
    if (asked != Search::Auto) return asked;
    return crowded ? Search::SphereTree : Search::Grid;
}

} // namespace brittle
