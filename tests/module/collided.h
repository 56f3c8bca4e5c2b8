// Colliders of whole fractures, as an outsider sees them.
#pragma once

#include "modules/brittle/fracture/fracture.h"
#include "tests/module/whole_fracture.h"
#include "tests/reference/convex.h"

namespace whole {

reference::Convex convexOf(const brittle::ColliderSet& colliders, uint32_t piece);

// Largest coordinate of the model from its center: its event's grid has steps of at most 2^-22 times that.
double reachOf(const Model& model);

brittle::FractureResult brokenWith(uint32_t directions, const Model& model, brittle::FractureOptions options);

// Every piece is closed and convex, holds its fragment and lies in its cell, all but for a few steps of the grid; no two
// overlap but those that are listed.
void expectColliders(const Model& model, const brittle::FractureResult& result);

// Of all pieces over all fragments, as a part of these.
double excessOf(const brittle::FragmentSet& set);

} // namespace whole
