// Reads FBX and COLLADA by assimp, in meters with y up. It may abort, crash or go round in circles: call it in a process of its
// own. Debian's build of it has no handler to install for its assertions.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace brittle {

// `ending` tells the format, in lower case with its dot.
engine::Result<ImportedMesh> readByAssimp(const std::filesystem::path& path, const std::string& ending);
engine::Result<ImportedMesh> readByAssimp(std::string_view bytes, const std::string& ending);

} // namespace brittle
