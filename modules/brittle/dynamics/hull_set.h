// Hulls on the host: convex pieces in the frame of their body, packed as the kernels read them (shaders-spirv/shared/hull.h).
#pragma once

#include "engine/result.h"
#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/hull.h"

#include <cstdint>
#include <span>
#include <vector>

namespace brittle {

struct HullSet {
    std::vector<gpu::HullRecord> records;
    std::vector<gpu::vec4> vertices;
    std::vector<gpu::HullFace> faces;
    std::vector<uint32_t> corners;
    std::vector<gpu::uvec4> edges;
};

// Adds a hull and returns its index. `vertices` in meters, from the body's center of mass along its own axes; `loops` are its
// faces, vertices counterclockwise seen from outside. A triangle of a static mesh is a hull of three vertices and two faces,
// one the other's reverse. Planes and edges are derived; of a face whose loop is too thin to tell its plane, the normal of that
// number counts, if there are `normals`. `hidden_sides`: of a triangle, as in gpu::HullFace. Where it fails the set is as it
// was: BadInput for coordinates that are not finite, surfaces that are not closed or not convex (vertices beyond a face by a
// thousandth of the hull's radius), Capacity for more than HULL_FACES, HULL_VERTICES or HULL_EDGES.
engine::Result<uint32_t> addHull(HullSet& set, std::span<const Float3> vertices, std::span<const std::vector<uint32_t>> loops,
                                 std::span<const Float3> normals = {}, uint32_t hidden_sides = 0);

} // namespace brittle
