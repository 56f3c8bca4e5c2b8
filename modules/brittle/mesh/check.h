// Whether a mesh bounds a solid: closed, consistently oriented, not passing through itself.
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/components.h"
#include "modules/brittle/mesh/mesh.h"
#include "modules/brittle/mesh/self_intersection.h"

#include <string>

namespace brittle {

struct MeshReport {
    uint32_t vertices = 0, triangles = 0;
    uint32_t components = 0;         // that hang together by edges
    uint32_t cavities = 0;           // of those, with negative volume: walls of a hollow
    uint32_t open_edges = 0;         // with one triangle
    uint32_t inconsistent_edges = 0; // with two triangles that run along it the same way
    uint32_t nonmanifold_edges = 0;  // with more triangles that do not pair up
    uint32_t shared_edges = 0;       // with more triangles that do pair up: surfaces that touch there, which is fine
    uint32_t duplicate_triangles = 0;
    uint32_t touching_triangles = 0; // with the corners of one of another component that faces them, which is fine
    uint32_t flat_triangles = 0;     // without area, which is fine
    uint32_t misplaced_components = 0;
    SelfIntersection self_intersection;
    MeshMeasures measures;
    std::vector<std::string> problems; // what keeps it from being broken, where, and what to do; none: it is sound
    bool isSound() const { return problems.empty(); }
};

// Triangles that have the same three corners as an earlier one. Two that face each other and belong to two solids are a wall
// between solids that touch, and are no fault. The same holds for a hollow and the solid that fills it.
struct Duplicates {
    std::vector<uint32_t> faulty;
    uint32_t walls = 0;
};
Duplicates findDuplicates(const Mesh& mesh, const Components& components);

// Looks for everything that may be wrong.
MeshReport inspectMesh(const Mesh& mesh, const MeshTopology& topology);

// Refuses, with the first problem, what does not bound a solid.
engine::Result<MeshReport> checkMesh(const Mesh& mesh, const MeshTopology& topology);

} // namespace brittle
