#include "modules/brittle/mesh/repair/mesh_edit.h"

#include "modules/brittle/mesh/triangle_shape.h"

namespace brittle {

void keepTriangles(Mesh& mesh, const std::vector<char>& keep) {
    size_t kept = 0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!keep[t]) continue;
        mesh.triangles[kept] = mesh.triangles[t];
        for (size_t k = 0; k < 3; ++k) {
            mesh.corner_normals[3 * kept + k] = mesh.corner_normals[3 * t + k];
            mesh.corner_uvs[3 * kept + k] = mesh.corner_uvs[3 * t + k];
        }
        ++kept;
    }
    mesh.triangles.resize(kept);
    mesh.corner_normals.resize(3 * kept);
    mesh.corner_uvs.resize(3 * kept);
}

void turnTriangle(Mesh& mesh, size_t triangle) {
    std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
    std::swap(mesh.corner_normals[3 * triangle + 1], mesh.corner_normals[3 * triangle + 2]);
    std::swap(mesh.corner_uvs[3 * triangle + 1], mesh.corner_uvs[3 * triangle + 2]);
    const Double3 front = doubleArea(cornersOf(mesh, triangle));
    for (size_t k = 0; k < 3; ++k) {
        Float3& normal = mesh.corner_normals[3 * triangle + k];
        if (dot(front, toDouble(normal)) < 0) normal = {-normal[0], -normal[1], -normal[2]};
    }
}

MeshCorner cornerOf(const Mesh& mesh, uint32_t half_edge) {
    return {mesh.triangles[half_edge / 3][half_edge % 3], mesh.corner_normals[half_edge], mesh.corner_uvs[half_edge]};
}

void replaceTriangle(Mesh& mesh, size_t triangle, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c) {
    mesh.triangles[triangle] = {a.vertex, b.vertex, c.vertex};
    size_t corner = 3 * triangle;
    for (const MeshCorner* from : {&a, &b, &c}) {
        mesh.corner_normals[corner] = from->normal;
        mesh.corner_uvs[corner++] = from->uv;
    }
}

void appendTriangle(Mesh& mesh, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c) {
    mesh.triangles.push_back({});
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    mesh.corner_uvs.resize(3 * mesh.triangles.size());
    replaceTriangle(mesh, mesh.triangles.size() - 1, a, b, c);
}

} // namespace brittle
