// From a scene as it is described to how its world is stepped.
#pragma once

#include "modules/brittle/dynamics/step_settings.h"
#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/scene/scene_description.h"

namespace brittle {

// Effects that a scene neither lists nor needs for those that it does are off. Errors: BadInput, for what the world has not got
// yet.
engine::Result<StepSettings> settingsOf(const SceneDescription& scene);
WorldBudget budgetOf(const SceneDescription& scene, uint32_t group_size = 0);

} // namespace brittle
