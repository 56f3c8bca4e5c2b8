// Finds the nodes of an FBX file whose transforms assimp applies in another way than the file says.
#pragma once

#include "modules/brittle/mesh/interchange/fbx_records.h"
#include "modules/brittle/mesh/mesh.h"

#include <map>
#include <set>

namespace brittle {

class FbxNodes {
public:
    // Ids of the children by that of the parent. The root is "0".
    using Children = std::map<std::string, std::vector<std::string>>;

    void add(const std::string& id, const std::string& name, const std::vector<FbxProperty>& properties);
    // Returns one note per kind, about nodes with one of the meshes at or below them:
    //   RotationActive is 0, yet assimp applies PreRotation and PostRotation
    //   InheritType is 0 or 2, yet assimp inherits the scale as by type 1; only if the shape depends on it
    std::vector<std::string> notes(const Children& children, const std::set<std::string>& meshes) const;

private:
    struct Node {
        std::string name;
        Double3 scale = {1, 1, 1};
        Double3 rotation = {0, 0, 0}, before = {0, 0, 0}, behind = {0, 0, 0}; // degrees
        int inherit_type = 1;
        bool is_rotation_active = true;
    };
    // A node, and the scales above it.
    struct Visit {
        std::string id;
        Double3 inherited_scale, parent_scale;
    };

    static bool dependsOnType(const Node& node, const Visit& visit);
    static std::set<std::string> ancestorsOf(const std::set<std::string>& meshes, const Children& children);

    template <class VisitNode>
    void walk(const Children& children, const std::set<std::string>& meshes, const VisitNode& visit_node) const;

    std::map<std::string, Node> nodes_;
};

} // namespace brittle
