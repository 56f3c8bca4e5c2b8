// Where things are: the engine's transforms may scale, shear and mirror; Brittle's bodies turn and move. So a body's shape is
// given with scale, shear and mirroring applied, and its node's transform is the body's with them put back.
#pragma once

#include "modules/brittle/brittle.h"
#include "modules/brittle/godot/interface/value.h"

namespace brittle_godot {

// A transform parted into what moves and what does not: basis = turn * stretch.
struct Placement {
    BrittleVec3 position = {0, 0, 0};
    BrittleQuat rotation = {0, 0, 0, 1};
    Transform stretch; // without an origin
    bool is_mirrored = false;
    bool is_flat = false; // it has no volume, and no turn that means anything
};

Placement placementOf(const Transform& transform);
// The transform of a node whose body is at `position` with `rotation`.
Transform transformOf(const BrittleVec3& position, const BrittleQuat& rotation, const Transform& stretch);
Transform product(const Transform& outer, const Transform& inner);
Transform inverse(const Transform& transform); // of one that is not flat
Vec3 moved(const Transform& transform, const Vec3& point);
// Of a normal: by the cofactors of the basis, so that it stays one where the basis shears. Not of unit length.
Vec3 turnedNormal(const Transform& transform, const Vec3& normal);

BrittleVec3 toBrittle(const Vec3& v);
Vec3 toEngine(const BrittleVec3& v);

} // namespace brittle_godot
