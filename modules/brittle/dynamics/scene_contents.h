// From a scene as it is described to what a world is made of.
#pragma once

#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>

namespace brittle {

// Bodies in the order of the scene, then its colliders. A body that is broken from the start is a body for each of its cells,
// one that is not has a piece for each. A plane is the upper side of a box a kilometer wide. `fracture` is only needed, and may
// else be nullptr, where bodies have cells. Errors: BadInput, with the body's name; what breaking it fails with.
engine::Result<WorldContents> contentsOf(const SceneDescription& scene, const std::filesystem::path& folder,
                                         Fracture* fracture);

// Effects that a scene does not list are off. Errors: BadInput, for what the world has not got yet.
engine::Result<StepSettings> settingsOf(const SceneDescription& scene);

} // namespace brittle
