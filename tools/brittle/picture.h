// Draws fragments, moved apart.
#pragma once

#include "engine/device.h"
#include "engine/image_io.h"
#include "modules/brittle/fracture/fragments.h"

#include <filesystem>

namespace cli {

struct PictureSize {
    uint32_t width = 1600, height = 1200;
};

// Every fragment moves from the center by `explode` times the distance of its own centroid from there.
engine::Result<engine::Picture> pictureOf(engine::Device& device, const brittle::FragmentSet& fragments, double explode,
                                          const PictureSize& size = {});
// The same, into a PNG file.
engine::Result<void> drawFragments(engine::Device& device, const brittle::FragmentSet& fragments, double explode,
                                   const std::filesystem::path& path);

} // namespace cli
