// Looks through the text of a COLLADA file for parts that assimp reads wrongly without a word.
#pragma once

#include "engine/result.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace brittle {

struct ColladaText {
    std::string text;                 // without comments; units, axes and rotations as assimp can read them
    std::vector<std::string> notes;   // of an impossible unit, an unknown axis, other scenes, matrices of skins
    std::set<std::string> geometries; // ids of all that the file has
};

// BadInput, with the line, for:
//   skewed nodes; matrices that are no affine transforms; rotations and lookats without a direction
//   triangle fans; morphs, because assimp 5.2 does not find their meshes
//   polygons with holes; negative indices; primitives without a count
//   accessors that reach beyond their arrays, or whose params have no names
engine::Result<ColladaText> checkCollada(std::string_view text);

} // namespace brittle
