// Views compressed by EXT_meshopt_compression.
#pragma once

#include "modules/brittle/mesh/gltf/element.h"

#include <string>
#include <string_view>

namespace brittle::gltf {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

// Returns the bytes of the view as it would be without compression. `extension` is the object of the view's extension.
std::string decodeMeshopt(const Element& extension, std::string_view compressed);

} // namespace brittle::gltf
