// The engine's meshes as Brittle's triangles. The engine's front faces are clockwise, Brittle's counterclockwise.
#pragma once

#include "modules/brittle/godot/conversion/placement.h"
#include "modules/brittle/godot/simulation/world_plan.h"

namespace brittle_godot {

// All surfaces of a Mesh in one, stretched. Normals and texture coordinates where every surface has them. Throws Failure where
// the mesh has no triangles.
Triangles trianglesOf(const Value& mesh, const Placement& placement);

struct Bounds {
    Vec3 least, most;
    Vec3 middle() const { return {(least.x + most.x) / 2, (least.y + most.y) / 2, (least.z + most.z) / 2}; }
};
Bounds boundsOf(const Triangles& triangles);

} // namespace brittle_godot
