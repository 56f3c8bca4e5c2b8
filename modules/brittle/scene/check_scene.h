// Whether a scene can be: every value within what its key allows, every body a solid with a mass.
//
// Descriptions come from files and from programs alike; both are checked here and nowhere else.
#pragma once

#include "engine/result.h"
#include "modules/brittle/scene/scene_keys.h"

#include <optional>

namespace brittle {

struct SceneProblem {
    SectionId section = SectionId::Scene;
    size_t index = 0;     // of a repeated section
    std::string_view key; // empty where the whole of it is wrong
    std::string message;  // one line, names the body or collider
};

// The first problem in the order of the file, none where there is none. Hulls are made of points and bodies are weighed; model
// files are not opened.
std::optional<SceneProblem> findProblem(const SceneDescription& scene);

// The same of one body, as a program adds it to a world. `index` is what a body without a name is called by; `materials` are
// those that it may be of besides the built-in ones.
std::optional<SceneProblem> findProblem(const BodyDescription& body, size_t index,
                                        std::span<const MaterialDescription> materials = {});

// Errors: BadInput, the first problem's message.
engine::Result<void> checkScene(const SceneDescription& scene);
engine::Result<void> checkBody(const BodyDescription& body, size_t index, std::span<const MaterialDescription> materials = {});

} // namespace brittle
