// How a cell finds the sites that may cut it (the paper, section 4). All ways give the same cells; they differ in time.
#pragma once

#include <cstdint>

namespace brittle {

enum class Search : uint8_t {
    Auto,       // grid: on no device and at no number of sites was another measured to be faster
    Linear,     // all sites, through shared memory; refused above MOST_LINEAR_SITES
    SphereTree, // the paper's, figure 7
    Grid,       // bins of a few sites each
};

constexpr Search chosenSearch(Search asked) { return asked == Search::Auto ? Search::Grid : asked; }

} // namespace brittle
