// From a scene as it is described to what a world is made of.
#pragma once

#include "modules/brittle/dynamics/body_surface.h"
#include "modules/brittle/dynamics/world.h"
#include "modules/brittle/fracture/fracture.h"
#include "modules/brittle/scene/scene_description.h"

#include <filesystem>
#include <memory>

namespace brittle {

// The fracture that cuts what the scene has to cut, with kernels of that group size (see Fracture::create); nullptr where no body has
// cells or is a mesh. Errors: those of Fracture::create.
engine::Result<std::unique_ptr<Fracture>> fractureFor(const SceneDescription& scene, engine::Device& device,
                                                      uint32_t group_size = 0);

// Bodies in the order of the scene, then its colliders. A body that is broken from the start is a body for each of its cells,
// one that is not has a piece for each. A plane is the upper side of a box a kilometer wide. `fracture` is that of
// fractureFor. What the bodies look like goes into `surfaces` where it is not nullptr: fragments as they were cut, models as
// they are, hulls for all else. Errors: BadInput, with the body's name; what breaking it fails with.
engine::Result<WorldContents> contentsOf(const SceneDescription& scene, const std::filesystem::path& folder, Fracture* fracture,
                                         WorldSurfaces* surfaces = nullptr);

// The same of a scene whose first body has been broken already, into `fragments`, with colliders. Its place is their center.
engine::Result<WorldContents> contentsOfBroken(const SceneDescription& scene, const FragmentSet& fragments,
                                               WorldSurfaces* surfaces = nullptr);

} // namespace brittle
