// Changes to the triangles of a mesh that keep what belongs to their corners with them.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <cstddef>
#include <vector>

namespace brittle {

// Keeps, in their order, the triangles for which `keep` holds something else than 0.
void keepTriangles(Mesh& mesh, const std::vector<char>& keep);

// The other side becomes its front. Normals of the corners that then point to its back are turned with it.
void turnTriangle(Mesh& mesh, size_t triangle);

struct MeshCorner {
    uint32_t vertex = 0;
    Float3 normal = {0, 0, 0}; // zero: still to be made
    Float2 uv = {0, 0};
};
MeshCorner cornerOf(const Mesh& mesh, uint32_t half_edge);
void appendTriangle(Mesh& mesh, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c);
void replaceTriangle(Mesh& mesh, size_t triangle, const MeshCorner& a, const MeshCorner& b, const MeshCorner& c);

} // namespace brittle
