// The scene of brittle shatter --drop.
#pragma once

#include "modules/brittle/fracture/fragments.h"
#include "modules/brittle/scene/scene_description.h"

#include <optional>
#include <string>

namespace cli {

// Named as the model is. One body where the model stood, which these are the fragments of, at rest, so high above a plane; half
// of the model's own height if no other is given. Small models are stepped finer, since they fall through their own size in
// less time. The camera sees all of it.
brittle::SceneDescription dropScene(const std::string& model, const brittle::FragmentSet& fragments,
                                    std::optional<double> height);

} // namespace cli
