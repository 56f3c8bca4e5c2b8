// Readers of our own for the four formats that carry bare triangles. They keep every digit of a double, take nothing on
// trust (a count in a header allocates nothing) and say where a broken file breaks. Errors do not name the file.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"

#include <cmath>
#include <string>
#include <string_view>

namespace brittle {

engine::Result<ImportedMesh> readObj(std::string_view bytes);
engine::Result<ImportedMesh> readOff(std::string_view bytes);
engine::Result<ImportedMesh> readPly(std::string_view bytes);
engine::Result<ImportedMesh> readStl(std::string_view bytes);

// For the readers themselves.
engine::Error badInput(std::string message);
engine::Error badLine(size_t line, const std::string& message);
bool looksBinary(std::string_view bytes); // holds a zero byte, which no text does

constexpr const char* kNotFinite = "a coordinate is not a finite number; remove that vertex and export again";

} // namespace brittle
