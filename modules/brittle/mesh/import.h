// Reads a model from a file: OBJ, PLY, STL, OFF, GLB and glTF by readers of our own; FBX and DAE by assimp.
//
// Assimp aborts, crashes or never ends on some broken files, and GLB may hold data compressed by other libraries. These
// formats are read in a process of its own (engine/isolated.h), which is forked for the one file. The mesh that it hands over
// is checked like a file.
#pragma once

#include "engine/isolated.h"
#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <filesystem>
#include <string_view>

namespace brittle {

// All meshes of the file as one, nodes' transforms applied. Texture coordinates follow glTF: v points down. FBX and DAE arrive
// in meters with y up, the other formats as they are.
// BadInput for whatever cannot be read, in one line that begins with the file's name; no file crashes or hangs the process.
engine::Result<ImportedMesh> importMesh(const std::filesystem::path& path);

// The same from memory; `ending` tells the format, dot and all. What lies in other files beside it (the buffers of a glTF) is
// missing. The limits are those of that process; by default as for a file of that size.
engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending, const engine::IsolationLimits& limits);
engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending);

} // namespace brittle
