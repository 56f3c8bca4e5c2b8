// Nodes: their tree, their transforms, and which of them the scene to read holds.
#pragma once

#include "modules/brittle/mesh/gltf/accessors.h"
#include "modules/brittle/mesh/gltf/notes.h"
#include "modules/brittle/mesh/transform.h"

namespace brittle::gltf {

struct Scene {
    std::vector<Transform> worlds;    // of all nodes of the file
    std::vector<uint64_t> mesh_nodes; // nodes of the scene that have a mesh, parents first
};

// Reads the default scene; the first one if the file names none; all nodes if it has no scene. Refuses nodes with two parents
// and nodes within themselves.
Scene readScene(const Document& document, Notes& notes);

// Transforms of the instances of a node by EXT_mesh_gpu_instancing, within the node; one identity for any other node.
constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
std::vector<Transform> instancesOf(const Element& node, Accessors& accessors);

} // namespace brittle::gltf
