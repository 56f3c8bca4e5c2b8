#include "modules/brittle/godot/conversion/mesh_out.h"

namespace brittle_godot {
namespace {

// Mesh.ArrayType and Mesh.PrimitiveType
constexpr int kArrayVertex = 0, kArrayNormal = 1, kArrayTexUv = 4, kArrayMax = 13, kPrimitiveTriangles = 3;

// The engine's front faces are clockwise.
Value arraysOf(std::span<const BrittleVertex> vertices) {
    constexpr size_t kTurnedOver[] = {0, 2, 1};
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    for (size_t k = 0; k < vertices.size(); ++k) {
        const BrittleVertex& v = vertices[k - k % 3 + kTurnedOver[k % 3]];
        positions.push_back({v.position[0], v.position[1], v.position[2]});
        normals.push_back({v.normal[0], v.normal[1], v.normal[2]});
        uvs.push_back({v.uv[0], v.uv[1]});
    }
    Value arrays = Value::empty(Type::Array);
    arrays.call("resize", {kArrayMax});
    arrays.setAt(kArrayVertex, Value::packed<Vec3>(positions));
    arrays.setAt(kArrayNormal, Value::packed<Vec3>(normals));
    arrays.setAt(kArrayTexUv, Value::packed<Vec2>(uvs));
    return arrays;
}

void addSurface(const Value& mesh, std::span<const BrittleVertex> vertices, const char* name, const Value& material) {
    if (vertices.empty()) return;
    const int64_t index = mesh.call("get_surface_count").asInt();
    mesh.call("add_surface_from_arrays", {kPrimitiveTriangles, arraysOf(vertices)});
    mesh.call("surface_set_name", {index, name});
    if (!material.isNull()) mesh.call("surface_set_material", {index, material});
}

} // namespace

Value arrayMeshOf(const FragmentSurface& surface, const Value& outer_material, const Value& cut_material) {
    Value mesh = newObject("ArrayMesh");
    const std::span<const BrittleVertex> all(surface.vertices);
    addSurface(mesh, all.first(surface.outer), "outer", outer_material);
    addSurface(mesh, all.subspan(surface.outer), "cut", cut_material);
    return mesh;
}

} // namespace brittle_godot
