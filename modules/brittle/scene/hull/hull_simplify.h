// A hull of fewer faces that holds the one given, for bodies with more than collision takes.
//
// It is cut from outside, never from inside: a solid of planes behind each of which the whole hull lies. That it begins with is
// the box of the hull with its edges and corners cut off, 26 planes; then planes of the hull's own faces are added, always the
// one that the solid still reaches furthest beyond, until there are 64. So nothing that touched the hull passes through the
// simpler one, and what is flat and large stays flat.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/hull/convex_hull.h"

namespace brittle {

struct SimpleHull {
    ConvexHull hull;
    double loosened = 0; // m: the furthest that a vertex lies beyond a plane of the hull given
};

// At most kMaxHullFaces faces and kMaxHullVertices vertices. Errors: Internal, where the planes' rounding leaves no solid.
engine::Result<SimpleHull> simplify(const ConvexHull& hull);

} // namespace brittle
