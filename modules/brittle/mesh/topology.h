// Edges of a mesh and what lies across them.
#pragma once

#include "modules/brittle/mesh/mesh.h"

namespace brittle {

constexpr uint32_t kNoMate = 0xffffffff; // across a half-edge of an open or inconsistently oriented mesh

// Edges come in ascending order. Around an edge of more than two triangles every half-edge is paired with the one that bounds
// the same wedge of solid, so that surfaces which merely touch there stay apart.
MeshTopology buildTopology(const Mesh& mesh);

// Returns whether a closed surface has edges of more than two triangles.
bool touchesItself(const MeshTopology& topology);

} // namespace brittle
