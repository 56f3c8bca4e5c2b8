// The files that are read for a model or a scene: a command must not write over them.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cli {

// The model, and the buffers that a .gltf names. Buffers that cannot be read are listed all the same.
std::vector<std::filesystem::path> filesOfModel(const std::filesystem::path& model);

// The files of all models of the scene, bodies first. `folder`: from which names of models count.
std::vector<std::filesystem::path> modelFilesOf(const brittle::SceneDescription& scene, const std::filesystem::path& folder);

// The same, and the scene's own file. `source`: a .toml file or the name of a built-in scene.
std::vector<std::filesystem::path> filesOfScene(const std::string& source, const brittle::SceneDescription& scene);

// Errors: BadInput if `output` is one of `inputs`, under whatever name. An empty `output` is no file.
engine::Result<void> checkIsNoInput(const std::string& output, const std::vector<std::filesystem::path>& inputs);

} // namespace cli
