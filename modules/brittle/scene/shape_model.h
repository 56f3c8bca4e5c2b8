// The model that a shape takes its form from.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/imported_mesh.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>

namespace brittle {

constexpr std::string_view kBuiltinModel = "builtin:"; // what the names of models begin with that are no files

// Of a hull or mesh by a file, or by a model in memory, scaled, in the shape's own frame. A relative name counts from `folder`. Errors: BadInput, for a
// file that cannot be read.
engine::Result<ImportedMesh> readModel(const ShapeDescription& shape, const std::filesystem::path& folder);

} // namespace brittle
