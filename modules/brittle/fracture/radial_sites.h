// Sites in sectors and rings about a blow on a plate, for Pattern::Radial.
//
// All rings have their sites at the same angles, and all sectors at the same radii: of two sectors' sites those of one ring are
// mirrored about the spoke between them. So what parts cells are exactly spokes through the blow, and pieces of rings that meet
// on these; radii grow by one ratio from ring to ring, so that cells are alike but for their size. That holds up to the rim
// only if sites beyond it are there too: a site is taken where its cell has a part in the plate, be the site itself outside of
// it.
//
// Bodies that break in worlds have the same law (shaders-spirv/lib/draw_radial.glsl), there with as many spokes and rings as
// the blow pays for. Here it is the number of sites that is asked for. Cells are to be half as long again as wide, and the
// innermost ring to have the radius of the contact: that gives the number of spokes and the ratio. Rings are laid from the rim
// inwards until all sites are placed; what is left over for the innermost ring does not go around.
#pragma once

#include "engine/result.h"
#include "modules/brittle/fracture/pattern.h"
#include "modules/brittle/mesh/mesh.h"

#include <vector>

namespace brittle {

// Exactly so many (at least one), model space; angles and the rings' phase follow from the seed. The blow is moved along the
// plate's normal into its middle plane. Errors: BadInput where the mesh is no plate, thinner than a third of its width, or the
// blow lies beside its box; Capacity where there is no room for so many.
engine::Result<std::vector<Double3>> radialSites(const Mesh& mesh, const Impact& impact, uint32_t count, uint64_t seed);

} // namespace brittle
