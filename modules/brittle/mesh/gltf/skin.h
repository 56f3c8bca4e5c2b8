// Skins in the default pose.
#pragma once

#include "modules/brittle/mesh/gltf/scene.h"

#include <functional>

namespace brittle::gltf {

// Matrix of each joint of a skin: its world transform times its inverse bind matrix.
std::vector<Transform> jointMatrices(const Document& document, uint64_t skin, const std::string& user, const Scene& scene,
                                     Accessors& accessors);

// Joints of the vertices of a primitive and their weights, `per_vertex` of each.
struct Influences {
    size_t per_vertex = 0;
    std::vector<uint32_t> joints;
    std::vector<double> weights;
    uint64_t scaled = 0;     // vertices whose weights did not add up to 1
    uint64_t weightless = 0; // vertices without any weight: they follow their first joint
    bool isEmpty() const { return per_vertex == 0; }
};

// Numbers of an attribute by its name and its components per vertex.
using AttributeSource = std::function<std::vector<double>(const std::string& name, uint32_t components)>;

// Reads JOINTS_0, JOINTS_1 and so on of a primitive, and the weights; weights of a vertex add up to 1 afterwards.
Influences readInfluences(const Element& attributes, uint64_t vertices, const AttributeSource& source);

// Weighted sum of the matrices of a vertex's joints.
Transform blend(const Influences& influences, const std::vector<Transform>& joints, uint64_t vertex, const std::string& where);

} // namespace brittle::gltf
