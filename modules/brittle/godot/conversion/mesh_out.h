// Fragments as meshes of the engine's.
#pragma once

#include "modules/brittle/godot/interface/value.h"
#include "modules/brittle/godot/simulation/running_world.h"

namespace brittle_godot {

// An ArrayMesh whose first surface, "outer", is what was the body's own and whose last, "cut", is what breaking laid open; one
// of them where there is only that. Materials may be null.
Value arrayMeshOf(const FragmentSurface& surface, const Value& outer_material, const Value& cut_material);

} // namespace brittle_godot
