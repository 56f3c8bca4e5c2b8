#include "modules/brittle/mesh/interchange/fbx_nodes.h"

#include "modules/brittle/mesh/format.h"

#include <algorithm>
#include <cmath>

namespace brittle {
namespace {

bool isZero(const Double3& v) { return v == Double3{0, 0, 0}; }
bool isSame(double a, double b) { return std::abs(a - b) <= 1e-4 * std::max(std::abs(a), std::abs(b)); }
bool isUniform(const Double3& scale) { return isSame(scale[0], scale[1]) && isSame(scale[1], scale[2]); }

// True if it makes no difference which of the two comes first. Half turns keep the axes.
bool commute(const Double3& degrees, const Double3& scale) {
    constexpr double kRounding = 1e-3;
    size_t turned_axes = 0, axis = 0;
    for (size_t k = 0; k < 3; ++k)
        if (std::abs(std::remainder(degrees[k], 180)) > kRounding) {
            ++turned_axes;
            axis = k;
        }
    if (turned_axes == 1) return isSame(scale[(axis + 1) % 3], scale[(axis + 2) % 3]);
    return turned_axes == 0 || isUniform(scale);
}

void addNote(std::vector<std::string>& notes, const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) notes.push_back(what + formatCount(names.size(), "node", "nodes") + ": " + formatList(names));
}

} // namespace

void FbxNodes::add(const std::string& id, const std::string& name, const std::vector<FbxProperty>& properties) {
    Node node{.name = name};
    for (const FbxProperty& property : properties) {
        const std::vector<double>& n = property.numbers;
        const Double3 triple = n.size() == 3 ? Double3{n[0], n[1], n[2]} : Double3{0, 0, 0};
        if (property.name == "Lcl Scaling" && n.size() == 3) node.scale = triple;
        if (property.name == "Lcl Rotation") node.rotation = triple;
        if (property.name == "PreRotation") node.before = triple;
        if (property.name == "PostRotation") node.behind = triple;
        if (property.name == "RotationActive" && n.size() == 1) node.is_rotation_active = n[0] != 0;
        if (property.name == "InheritType" && n.size() == 1) node.inherit_type = n[0] == 0 ? 0 : n[0] == 2 ? 2 : 1;
    }
    nodes_[id] = node;
}

// Scales of all nodes above: their product is exact unless rotations lie between them.
bool FbxNodes::dependsOnType(const Node& node, const Visit& visit) {
    if (node.inherit_type == 1) return false;
    const Double3& parent = visit.parent_scale;
    if (node.inherit_type == 2 && !(isUniform(parent) && isSame(parent[0], 1))) return true;
    for (const Double3& rotation : {node.rotation, node.before, node.behind})
        if (!commute(rotation, visit.inherited_scale)) return true;
    return false;
}

std::set<std::string> FbxNodes::ancestorsOf(const std::set<std::string>& meshes, const Children& children) {
    Children parents;
    for (const auto& [parent, below] : children)
        for (const std::string& child : below)
            parents[child].push_back(parent);
    std::set<std::string> reached;
    std::vector<std::string> waiting(meshes.begin(), meshes.end());
    while (!waiting.empty()) {
        const std::string id = waiting.back();
        waiting.pop_back();
        for (const std::string& parent : parents[id])
            if (reached.insert(parent).second) waiting.push_back(parent);
    }
    return reached;
}

// Calls visit_node(node, visit) for the nodes with one of the meshes at or below them, parents first.
template <class VisitNode>
void FbxNodes::walk(const Children& children, const std::set<std::string>& meshes, const VisitNode& visit_node) const {
    const std::set<std::string> shown = ancestorsOf(meshes, children);
    std::set<std::string> walked;
    std::vector<Visit> waiting = {{"0", {1, 1, 1}, {1, 1, 1}}};
    while (!waiting.empty()) {
        const Visit visit = waiting.back();
        waiting.pop_back();
        const auto found = nodes_.find(visit.id);
        const Node node = found == nodes_.end() ? Node{} : found->second;
        visit_node(node, visit);
        const Double3& scales = visit.inherited_scale;
        const Double3 scale = {scales[0] * node.scale[0], scales[1] * node.scale[1], scales[2] * node.scale[2]};
        const auto below = children.find(visit.id);
        for (const std::string& child : below == children.end() ? std::vector<std::string>() : below->second)
            if (nodes_.contains(child) && shown.contains(child) && walked.insert(child).second)
                waiting.push_back({child, scale, node.scale});
    }
}

std::vector<std::string> FbxNodes::notes(const Children& children, const std::set<std::string>& meshes) const {
    std::vector<std::string> turned, inherited;
    walk(children, meshes, [&](const Node& node, const Visit& visit) {
        if (!node.is_rotation_active && !(isZero(node.before) && isZero(node.behind))) turned.push_back(node.name);
        if (dependsOnType(node, visit)) inherited.push_back(node.name);
    });
    std::vector<std::string> notes;
    addNote(notes, "PreRotation and PostRotation are applied although RotationActive is 0, at ", turned);
    addNote(notes, "the scale is inherited as by InheritType 1 (RSrs) although the file has another, at ", inherited);
    return notes;
}

} // namespace brittle
