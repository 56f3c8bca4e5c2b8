#include "modules/brittle/godot/conversion/mesh_in.h"

#include "modules/brittle/godot/failure.h"

#include <algorithm>
#include <numeric>

namespace brittle_godot {
namespace {

// Mesh.ArrayType and Mesh.PrimitiveType
constexpr int kArrayVertex = 0, kArrayNormal = 1, kArrayTexUv = 4, kArrayIndex = 12, kPrimitiveTriangles = 3;

struct Surface {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<int32_t> indices;
};

// Only an ArrayMesh may be of anything but triangles.
bool hasTriangles(const Value& mesh, int64_t surface) {
    if (!mesh.call("is_class", {"ArrayMesh"}).asBool()) return true;
    return mesh.call("surface_get_primitive_type", {surface}).asInt() == kPrimitiveTriangles;
}

Surface surfaceOf(const Value& mesh, int64_t index) {
    const Value arrays = mesh.call("surface_get_arrays", {index});
    Surface s;
    s.positions = arrays.at(kArrayVertex).asVector<Vec3>();
    s.normals = arrays.at(kArrayNormal).asVector<Vec3>();
    s.uvs = arrays.at(kArrayTexUv).asVector<Vec2>();
    s.indices = arrays.at(kArrayIndex).asVector<int32_t>();
    for (const int32_t corner : s.indices)
        if (static_cast<size_t>(corner) >= s.positions.size()) throw Failure("its mesh has an index beyond its vertices");
    if (s.indices.empty()) {
        s.indices.resize(s.positions.size() / 3 * 3);
        std::iota(s.indices.begin(), s.indices.end(), 0);
    }
    return s;
}

void append(std::vector<float>& list, const Vec3& v) { list.insert(list.end(), {v.x, v.y, v.z}); }

// Mirroring turns faces over once more.
void addIndices(const Surface& s, uint32_t first, bool is_mirrored, std::vector<uint32_t>& indices) {
    for (size_t k = 0; k + 2 < s.indices.size(); k += 3) {
        const auto corner = [&](size_t c) { return first + static_cast<uint32_t>(s.indices[k + c]); };
        if (is_mirrored)
            indices.insert(indices.end(), {corner(0), corner(1), corner(2)});
        else
            indices.insert(indices.end(), {corner(0), corner(2), corner(1)});
    }
}

void addSurface(const Surface& s, const Placement& placement, Triangles& all) {
    const auto first = static_cast<uint32_t>(all.vertexCount());
    for (const Vec3& p : s.positions)
        append(all.positions, moved(placement.stretch, p));
    for (const Vec3& n : s.normals)
        append(all.normals, turnedNormal(placement.stretch, n));
    for (const Vec2& uv : s.uvs)
        all.uvs.insert(all.uvs.end(), {uv.x, uv.y});
    addIndices(s, first, placement.is_mirrored, all.indices);
}

} // namespace

Triangles trianglesOf(const Value& mesh, const Placement& placement) {
    Triangles all;
    const int64_t count = mesh.isNull() ? 0 : mesh.call("get_surface_count").asInt();
    for (int64_t k = 0; k < count; ++k)
        if (hasTriangles(mesh, k)) addSurface(surfaceOf(mesh, k), placement, all);
    if (all.indices.empty()) throw Failure("its mesh has no triangles");
    if (all.normals.size() != all.positions.size()) all.normals.clear();
    if (all.uvs.size() != 2 * all.vertexCount()) all.uvs.clear();
    return all;
}

Bounds boundsOf(const Triangles& t) {
    Bounds b = {{t.positions[0], t.positions[1], t.positions[2]}, {t.positions[0], t.positions[1], t.positions[2]}};
    for (size_t k = 0; k < t.positions.size(); k += 3) {
        const Vec3 p = {t.positions[k], t.positions[k + 1], t.positions[k + 2]};
        b.least = {std::min(b.least.x, p.x), std::min(b.least.y, p.y), std::min(b.least.z, p.z)};
        b.most = {std::max(b.most.x, p.x), std::max(b.most.y, p.y), std::max(b.most.z, p.z)};
    }
    return b;
}

} // namespace brittle_godot
