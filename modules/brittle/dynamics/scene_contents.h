// From a scene as it is described to what a world is made of.
#pragma once

#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>

namespace brittle {

// Whether it has bodies with cells, which fracture has to cut.
bool needsFracture(const SceneDescription& scene);

// Bodies in the order of the scene, then its colliders. A body that is broken from the start is a body for each of its cells,
// one that is not has a piece for each. A plane is the upper side of a box a kilometer wide. `fracture` is only needed, and may
// else be nullptr, where bodies have cells. What the bodies look like goes into `surfaces` where it is not nullptr: fragments
// as they were cut, models as they are, hulls for all else. Errors: BadInput, with the body's name; what breaking it fails
// with.
engine::Result<WorldContents> contentsOf(const SceneDescription& scene, const std::filesystem::path& folder, Fracture* fracture,
                                         WorldSurfaces* surfaces = nullptr);

// The same of a scene whose first body has been broken already, into `fragments`, with colliders. Its place is their center.
engine::Result<WorldContents> contentsOfBroken(const SceneDescription& scene, const FragmentSet& fragments,
                                               WorldSurfaces* surfaces = nullptr);

} // namespace brittle
