// Reads the triangles of a model: OBJ, STL (text and binary) and OFF. No repair, no welding: the file as it stands.
#pragma once

#include "tests/reference/geometry.h"

#include <string>

namespace reference {

// Throws std::runtime_error where the file cannot be read.
Triangles readModel(const std::string& path);

} // namespace reference
