// Fragments and models in memory, as the checker of the contract takes them from files.
#pragma once

#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/mesh/mesh.h"
#include "tests/reference/glb_file.h"

namespace support {

reference::FragmentFile fragmentFile(const brittle::FragmentSet& set);
reference::Triangles trianglesOf(const brittle::Mesh& mesh); // model space

} // namespace support
