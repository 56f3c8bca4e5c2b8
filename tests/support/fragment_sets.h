// Fragments made by hand, for tests of what is done with them.
#pragma once

#include "modules/brittle/fracture/fragments.h"

namespace support {

// The unit cube about the origin, cut at x = 1/8. The outer triangles come first, as they should.
struct CubeInTwo {
    brittle::FragmentSet set;
    std::vector<brittle::Double3> sites;
};
CubeInTwo cubeInTwo();

} // namespace support
