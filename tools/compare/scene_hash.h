// A number that tells scenes apart.
#pragma once

#include "modules/brittle/scene/scene_description.h"

#include <filesystem>

namespace compare {

// Hashes all of a scene that its motion depends on, and the bytes of its models and their buffers; comment, camera and number
// of steps are left out. Numbers count to six digits: mathematical functions of two machines may differ in the last ones.
// `folder`: from which names of models count. A model that cannot be read counts as empty.
uint64_t hashOfScene(brittle::SceneDescription scene, const std::filesystem::path& folder);

} // namespace compare
