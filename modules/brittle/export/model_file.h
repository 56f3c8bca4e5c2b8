// A model as a file: what importMesh reads back as the same mesh.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"

#include <string>
#include <string_view>

namespace brittle {

// The bytes of the file with that ending, dot and all, in any case: OBJ with normals and texture coordinates; OFF and PLY
// (text) without. Positions are in model space with every digit of a double, so that vertices stay apart that were. BadInput
// for other endings: STL, for one, has no room for the digits.
engine::Result<std::string> encodeModel(const Mesh& mesh, std::string_view ending);

} // namespace brittle
