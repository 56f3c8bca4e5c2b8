// The model that a command is about.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/prepare.h"

#include <string>

namespace cli {

constexpr const char* kModelHelp = "OBJ, PLY, STL, OFF, GLB, glTF, FBX or DAE file, or builtin:NAME";

// From a file, or by name after "builtin:". Read and prepared, not yet checked. Errors begin with the name given.
engine::Result<brittle::PreparedMesh> loadModel(const std::string& name);

} // namespace cli
