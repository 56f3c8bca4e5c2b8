// Fragments of a broken model as bodies that break again on the device: the records that tell of them, and what the host makes
// of each.
#pragma once

#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/mesh/prepare.h"
#include "shaders-spirv/shared/breaking.h"

#include <vector>

namespace breaking_test {

struct Breaking {
    brittle::FragmentSet set;
    std::vector<brittle::PreparedMesh> prepared; // by the host
    std::vector<gpu::BreakingRecord> records;
    uint32_t corners = 0, sites = 0;
};

// Every fragment, about the center that the host takes; `scale`: units of half a grid's edge in a unit, or 0 for those that the
// host takes.
Breaking breakingFragments(const char* model, uint32_t sites, float scale = 0);

// One object.
Breaking breakingSolid(const brittle::ImportedMesh& solid);

brittle::Float3 scaledPlace(const brittle::PreparedMesh& object, uint32_t vertex, float scale);

// A blow on the first vertex of each object, which is to have so many sites.
void hit(Breaking& breaking, uint32_t sites, int32_t contact_radius, int32_t seed);

} // namespace breaking_test
