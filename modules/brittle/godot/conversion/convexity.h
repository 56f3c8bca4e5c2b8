// Whether a mesh is convex: such collides by itself, others by cells.
#pragma once

#include "modules/brittle/godot/simulation/world_plan.h"

namespace brittle_godot {

// True where no edge of the mesh dents it and it is one piece. A closed surface that does not pass through itself is convex if
// and only if that holds, so no vertex has to be compared with more than the faces next to it.
bool isConvex(const Triangles& triangles);

} // namespace brittle_godot
