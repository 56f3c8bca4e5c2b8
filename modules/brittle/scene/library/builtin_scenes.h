// Scenes that are there without a file: what tests, the bench and the command line run. Among them are the scenes that break
// rigid-body engines, `hard_NN_...`: what each has to fulfill stands in its comment.
//
// Scenes of many random bodies draw them by a generator that is the same everywhere, so that a name is one scene.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_description.h"

#include <string>
#include <string_view>
#include <vector>

namespace brittle {

struct SceneEntry {
    std::string name;
    SceneDescription (*make)(uint32_t parameter) = nullptr;
    uint32_t parameter = 0;
};

// Every one that has a name of its own, in order.
const std::vector<SceneEntry>& builtinScenes();

// By name: one of these, or hull_pile_N (N from 1 to 100,000) or stack_N (N from 1 to 1,000). Errors: BadInput, with the
// nearest name.
engine::Result<SceneDescription> makeBuiltinScene(std::string_view name);

// Scenes that a world must refuse, with the words that the refusal has in it.
struct RefusedScene {
    SceneDescription scene;
    std::string_view reason;
};
std::vector<RefusedScene> refusedScenes();

} // namespace brittle
