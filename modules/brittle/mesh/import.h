// Reads a model from a file: OBJ, PLY, STL and OFF by readers of our own, which keep doubles; GLB, glTF, FBX and DAE by assimp.
//
// Assimp aborts, crashes or goes round in circles on some broken files. It runs in a process of its own (engine/isolated.h)
// that is forked for the one file, so that none of this reaches the caller's process. What it hands over is believed no more
// than a file.
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
// missing. The limits are those of assimp's process; by default as for a file of that size.
engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending, const engine::IsolationLimits& limits);
engine::Result<ImportedMesh> importMesh(std::string_view bytes, std::string_view ending);

} // namespace brittle
