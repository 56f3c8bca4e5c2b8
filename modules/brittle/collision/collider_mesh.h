// Colliders as meshes, to be looked at.
#pragma once

#include "modules/brittle/fracture/fragments.h"

namespace brittle {

// A fragment for every piece, with flat faces and in the same frame: faces of its cell are inner ones, all others outer ones.
// The centroid is the fragment's own, so that pieces move with their fragments. `set` is only read.
FragmentSet meshesOfColliders(const FragmentSet& set);

} // namespace brittle
