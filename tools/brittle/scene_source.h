// The scene that a command is about.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>
#include <string>

namespace cli {

constexpr const char* kSceneHelp = "a built-in scene, or a .toml file";

// From a file, if its name ends in .toml, else a built-in one. Errors: BadInput.
engine::Result<brittle::SceneDescription> readSceneOrBuiltin(const std::string& name);

// From where the names of the scene's models count.
std::filesystem::path folderOf(const std::string& name);

} // namespace cli
