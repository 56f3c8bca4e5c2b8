// Fragments as a binary glTF file.
//
// A node and a mesh per fragment, named fragment_0000 and on, with a primitive for the model's own surface (material `outer`)
// and one for the faces of this cut and earlier ones (`inner`). Positions are relative to the center of the model's box, which
// stands in every node's translation, in double: a model far from the origin keeps its bits. extras: site (model space), cell,
// volume.
//
// Where the set has colliders, every fragment's node has a child collider_0000 and on, with the piece as a mesh (material
// `collider`); extras: collider (the fragment), planes, volume, lacks (ColliderLack).
#pragma once

#include "engine/result.h"
#include "modules/brittle/fracture/fragments.h"

#include <string>

namespace brittle {

// The file's bytes: the same for the same fragments. Capacity where they exceed the 4 GiB that the format can hold.
engine::Result<std::string> encodeGlb(const FragmentSet& fragments);

} // namespace brittle
