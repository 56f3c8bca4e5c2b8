// Scene files: TOML (toml++ reads it, and nothing else here sees it). README.md has the keys.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace brittle {

constexpr size_t kMaxSceneBytes = 256u << 20;

// Reads and checks. Relative names of models stay as they are; they count from the scene file's folder.
// Errors: BadInput, one line that begins with FILE:LINE, for what is no TOML, for unknown keys (with the nearest known one),
// for values of another type or out of range (with what is allowed), and for all that checkScene refuses.
engine::Result<SceneDescription> readScene(const std::filesystem::path& path);
// The same of text; `name` is what errors call it.
engine::Result<SceneDescription> readScene(std::string_view text, const std::string& name);

// What readScene turns into the same description again, to the last bit of every number. Keys at their defaults are left out.
std::string writeScene(const SceneDescription& scene);

} // namespace brittle
