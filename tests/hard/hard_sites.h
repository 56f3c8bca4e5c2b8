// Site sets that break Voronoi code: ties, near ties, thin and huge boxes, crowded and empty space, cells with many faces.
//
// Every set is made by a fixed recipe, so that a failure can be named and made again. `hardSites()` is the corpus of 27; the
// generators below it make single sets of a wanted size.
#pragma once

#include "tests/reference/voronoi.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hard {

using Point = std::array<double, 3>;

struct HardSites {
    std::string name;
    Point lower = {0, 0, 0};
    Point upper = {1, 1, 1};
    std::vector<Point> sites; // in the closed box
};

std::vector<HardSites> hardSites();

// 1 + face_count sites; the first is the center of a sphere on which the others lie, so that its cell has face_count faces.
HardSites sphereAroundCenter(uint32_t face_count, double radius);
// side^3 sites in the middles of a cubic lattice: eight cells at every vertex.
HardSites cubicLattice(uint32_t side);
// `crowds` places in the unit box, each with `members` sites within `spread`.
HardSites clusters(uint32_t crowds, uint32_t members, double spread, uint32_t seed);
// About the middle of the unit box: even within the radius, outside thinner with the fourth power of the distance.
HardSites sitesAboutBlow(uint32_t count, double radius, uint32_t seed);
HardSites uniformSites(uint32_t count, uint32_t seed);

// The 24-bit grid of an event: the longest side of the box becomes 2^24 - 4 steps. Sites that fall together are welded.
struct GridSites {
    reference::SiteSet set;
    uint32_t welded = 0;
};
GridSites snapToGrid(const HardSites& hard);

} // namespace hard
