// The cards of materials that a scene names: built-in ones and its own.
#pragma once

#include "engine/result.h"
#include "modules/brittle/effects/material.h"
#include "modules/brittle/scene/scene_description.h"

#include <span>
#include <string_view>

namespace brittle {

// Whether the scene's own materials may not have that name: built-in ones, and tempered_glass, which is to come.
bool isTakenName(std::string_view name);

// The built-in card that it is like, with what it says otherwise, under its own name. Values are taken as they are: checkScene
// looks at them. Errors: BadInput, where `like` is no built-in name.
engine::Result<Material> derivedMaterial(const MaterialDescription& material);

// The card of that name, built in or among the scene's own. Errors: BadInput, for a name that neither has (with the nearest one
// that there is), and for tempered_glass, which waits for stress.
engine::Result<Material> materialOf(std::string_view name, std::span<const MaterialDescription> own);

// kg/m3: the body's own density, its material's, or kUsualDensity. It means nothing where a mass is given. Errors: those of
// materialOf, also where the density does not depend on it.
engine::Result<double> densityOf(const BodyDescription& body, std::span<const MaterialDescription> own);

} // namespace brittle
