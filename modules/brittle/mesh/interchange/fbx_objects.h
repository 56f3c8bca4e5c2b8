// Finds the parts of an FBX file that assimp leaves out or misreads without a word. Reads the sections Objects and Connections
// alone, of text and of binary files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace brittle {

// Returns one note per kind:
//   nodes that assimp moves in another way than the file says; see FbxNodes
//   blend shapes with a weight
//   meshes that no chain of connections leads to the root, as Geometry -> Model -> ... -> 0
//   geometries that are no meshes, such as NURBS
// Returns nothing for damaged files: assimp refuses those.
std::vector<std::string> noteLostGeometries(std::string_view fbx);

} // namespace brittle
