// FBX and COLLADA files of one box, as text that tests may change.
#pragma once

#include "modules/brittle/mesh/model_frame.h"

#include <string>

namespace support {

struct FbxSettings {
    double unit = 1; // centimeters
    brittle::FileAxis right = {0, 1}, up = {1, 1}, front = {2, 1};
};
std::string settingsBlock(const FbxSettings& settings);

// A box of that size in units of the file, its lower corner at the origin: geometry 100 in model 200. The model has that scale.
std::string fbx(const std::string& settings, const brittle::Double3& size, double node_scale = 1);

// The same box: geometry "g" in node "n" of scene "s". `asset` is the content of the element of that name.
std::string collada(const std::string& asset, const brittle::Double3& size);

// The text with `from` replaced, which must be there once.
std::string withReplaced(std::string text, const std::string& from, const std::string& to);

} // namespace support
