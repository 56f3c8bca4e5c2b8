// Extensions of glTF: required ones that are not read are refused, optional ones that may change the shape are noted.
#pragma once

#include "modules/brittle/mesh/gltf/element.h"
#include "modules/brittle/mesh/gltf/notes.h"

namespace brittle::gltf {

void checkVersion(const Document& document);
void checkExtensions(const Document& document, Notes& notes);

} // namespace brittle::gltf
