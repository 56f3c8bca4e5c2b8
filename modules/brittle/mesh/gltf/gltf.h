// Reads glTF 2.0 and GLB by the specification of the Khronos Group, with these extensions: KHR_mesh_quantization,
// KHR_draco_mesh_compression, KHR_texture_transform, EXT_mesh_gpu_instancing and EXT_meshopt_compression.
//
// The file passes through these steps:
//   container   GLB chunks, or the text itself
//   element     JSON, every number of which is checked when it is read
//   scene       nodes of the scene to read and their transforms; skins and instances
//   buffers     bytes of views: from the file, its neighbors or data: URIs, decompressed
//   accessors   numbers of any component type, interleaved or sparse
//   primitive   triangles of a primitive, at the default weights of its morph targets
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <functional>
#include <string>
#include <string_view>

namespace brittle {

// Returns the bytes of a file by its path relative to the model.
using ReadNeighbor = std::function<engine::Result<std::string>(const std::string& path)>;

// More vertices or triangles, with all instances, are refused.
constexpr uint64_t kMostGltfElements = uint64_t{1} << 27;

// All triangles of the default scene in model space, in its default pose. `notes` of the mesh say what is left out.
// BadInput in one line, without the name of the file. Throws nothing.
engine::Result<ImportedMesh> readGltf(std::string_view bytes, const ReadNeighbor& read_neighbor,
                                      uint64_t most_elements = kMostGltfElements);

} // namespace brittle
