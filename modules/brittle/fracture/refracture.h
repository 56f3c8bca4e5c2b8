// A fragment as a mesh that can be broken in its turn.
#pragma once

#include "engine/result.h"
#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/mesh/prepare.h"

namespace brittle {

// The fragment `fragment` of `set` as it stands: triangles in the fragment's order, with its normals and texture coordinates,
// and every corner at the very place where it was. Cut faces become part of the surface and are remembered as such
// (Mesh::own_triangles). `set` is only read; the mesh owns its data.
//
// The frame moves along with the fragment, so that a small one far from its set's center gets a grid of its own, as fine as its
// size calls for; by such amounts only as change no coordinate by rounding.
//
// A fragment is closed by its ids, and rounding its corners to floats may let it touch or cross itself: no check for that is
// made here, and checkMesh should not be asked. Corners at one place become one vertex, triangles that this collapses go, and
// what is left still has every edge as often one way as the other, which is all that shatter asks of a surface.
//
// Errors: BadInput where there is no such fragment, where it has no triangle with three corners, is not closed (that is, did
// not come from shatter), or is smaller than a model may be (1e-9 units).
engine::Result<PreparedMesh> prepareFragment(const FragmentSet& set, size_t fragment);

} // namespace brittle
