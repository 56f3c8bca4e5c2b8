// Where sites are placed in a solid.
#pragma once

#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/fracture.h"

#include <cstdint>

namespace brittle {

enum class Pattern : uint8_t {
    Uniform, // evenly
    Impact,  // evenly within the contact radius, outside thinner with the fourth power of the distance
    Paper,   // the paper's (section 2, figure 2): about the center of the box and the surface, drawn towards the impact
    Radial   // of plates: in sectors and rings about the impact, so that cells are parted by spokes and rings (radial_sites.h)
};

// A blow. A solid that is hit at no place in particular is hit at the center of its box.
struct Impact {
    Double3 place{0, 0, 0};                 // model space
    double contact_radius = 0;              // model units, which are meters where a strength is given
    double favor = 0;                       // 0 to 1: how often the paper's pattern takes the candidate nearest to the place
    uint32_t candidates = PAPER_CANDIDATES; // a site, of the paper's pattern: 1 to PAPER_LANES
};

// Of a blow of so many joules. The ball of this radius could hold its energy elastically: 18 kJ/m3, which annealed glass stores
// at its strength (50 MPa, E = 70 GPa: s^2 / 2E).
double contactRadiusOf(double joules);
// Half of the sites at one joule, nearly all at ten.
double favorOf(double joules);

} // namespace brittle
