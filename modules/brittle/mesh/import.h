// Reads a model from a file: OBJ, PLY, STL and OFF by readers of our own, which keep doubles; GLB, glTF, FBX and DAE by assimp.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <filesystem>

namespace brittle {

// All meshes of the file as one, nodes' transforms applied. Texture coordinates follow glTF: v points down.
// BadInput for whatever cannot be read, in one line that begins with the file's name; no file crashes or hangs the process.
engine::Result<ImportedMesh> importMesh(const std::filesystem::path& path);

} // namespace brittle
