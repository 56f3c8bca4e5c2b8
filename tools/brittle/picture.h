// Draws fragments, moved apart, into a PNG file.
#pragma once

#include "engine/device.h"
#include "modules/brittle/fracture/fragments.h"

#include <filesystem>

namespace cli {

// Every fragment moves from the center by `explode` times the distance of its own centroid from there.
engine::Result<void> drawFragments(engine::Device& device, const brittle::FragmentSet& fragments, double explode,
                                   const std::filesystem::path& path);

} // namespace cli
