#include "modules/brittle/mesh/interchange/fbx_objects.h"

#include "modules/brittle/mesh/format.h"
#include "modules/brittle/mesh/interchange/fbx_nodes.h"

#include <algorithm>
#include <map>
#include <set>

namespace brittle {
namespace {

struct Geometry {
    std::string id, name, kind;
};

struct Objects {
    std::vector<Geometry> geometries;
    std::set<std::string> models;
    FbxNodes nodes;
    std::vector<std::string> shapes; // names of blend shapes that change the mesh
    FbxNodes::Children children;
};

// Text has "Geometry::NAME", binary files have "NAME", two odd bytes and "Geometry".
std::string plainName(const std::string& name) {
    const size_t colons = name.find("::");
    if (colons != name.npos) return name.substr(colons + 2);
    return name.substr(0, name.find('\0'));
}

bool isShapeWithWeight(const FbxRecord& record) {
    if (record.key != "Deformer" || record.values.size() < 3 || record.values[2] != "BlendShapeChannel") return false;
    return std::ranges::any_of(record.properties, [](const FbxProperty& property) {
        return property.name == "DeformPercent" && !property.numbers.empty() && property.numbers.front() != 0;
    });
}

void addModel(Objects& objects, const FbxRecord& record) {
    const std::string &id = record.values[0], name = record.values.size() > 1 ? plainName(record.values[1]) : "";
    objects.models.insert(id);
    objects.nodes.add(id, name.empty() ? id : "\"" + name + "\"", record.properties);
}

Objects readObjects(std::string_view fbx) {
    Objects objects;
    forEachFbxRecord(fbx, [&](const FbxRecord& record) {
        const std::vector<std::string>& values = record.values;
        if (record.section == "Objects" && record.key == "Geometry" && values.size() >= 3)
            objects.geometries.push_back({values[0], plainName(values[1]), values[2]});
        if (record.section == "Objects" && record.key == "Model" && !values.empty()) addModel(objects, record);
        if (record.section == "Objects" && isShapeWithWeight(record))
            objects.shapes.push_back('"' + plainName(values[1]) + '"');
        // OP and PP connect properties, such as a texture's color. Assimp takes any other word for OO.
        const bool joins = record.key == "C" && values.size() >= 3 && values[0] != "OP" && values[0] != "PP";
        if (record.section == "Connections" && joins) objects.children[values[2]].push_back(values[1]);
    });
    return objects;
}

// Ids of all models below the root, and of what is connected to them.
std::set<std::string> connected(const Objects& objects) {
    std::set<std::string> reached, walked = {"0"};
    std::vector<std::string> waiting = {"0"};
    while (!waiting.empty()) {
        const std::string parent = waiting.back();
        waiting.pop_back();
        const auto children = objects.children.find(parent);
        if (children == objects.children.end()) continue;
        for (const std::string& child : children->second) {
            if (parent != "0") reached.insert(child);
            if (objects.models.contains(child) && walked.insert(child).second) waiting.push_back(child);
        }
    }
    return reached;
}

// Shapes are targets of morphs; lines have no surface and are noted when they are flattened.
bool isMissed(const std::string& kind) { return kind != "Mesh" && kind != "Shape" && kind != "Line"; }

} // namespace

std::vector<std::string> noteLostGeometries(std::string_view fbx) {
    const Objects objects = readObjects(fbx);
    const std::set<std::string> reached = connected(objects);
    std::vector<std::string> apart, others;
    std::set<std::string> meshes;
    for (const Geometry& geometry : objects.geometries) {
        const std::string name = geometry.name.empty() ? geometry.id : "\"" + geometry.name + "\"";
        if (geometry.kind == "Mesh") meshes.insert(geometry.id);
        if (geometry.kind == "Mesh" && !reached.contains(geometry.id)) apart.push_back(name);
        if (isMissed(geometry.kind)) others.push_back(name + " (" + geometry.kind + ")");
    }
    std::vector<std::string> notes = objects.nodes.notes(objects.children, meshes);
    const auto add = [&](const std::vector<std::string>& names, const char* one, const char* many) {
        if (!names.empty()) notes.push_back(formatCount(names.size(), one, many) + " left out: " + formatList(names));
    };
    add(objects.shapes, "blend shape with a DeformPercent other than 0 is",
        "blend shapes with a DeformPercent other than 0 are");
    add(apart, "mesh that no connection leads to the scene is", "meshes that no connection leads to the scene are");
    add(others, "geometry that is no mesh is", "geometries that are no meshes are");
    return notes;
}

} // namespace brittle
