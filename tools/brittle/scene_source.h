// The scene that a command is about.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>
#include <string>

namespace cli {

constexpr const char* kSceneHelp = "a built-in scene, an example, or a .toml file";

// Reads the file if the name ends in .toml, else the example or the built-in scene of that name. Errors: BadInput.
engine::Result<brittle::SceneDescription> readSceneOrBuiltin(const std::string& name);

// From where the names of the scene's models count.
std::filesystem::path folderOf(const std::string& name);

} // namespace cli
