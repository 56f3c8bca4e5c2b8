// A closed triangle mesh as fracture sees it.
//
// Positions are float32 relative to the center of the model's box, which is kept in double: a model far from the origin
// keeps all of its bits. Corners that share a position share an index, whatever their normals and texture coordinates,
// because the solid is what breaks; attributes are kept per corner, so that seams survive.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace brittle {

using Double3 = std::array<double, 3>;
using Float3 = std::array<float, 3>;
using Float2 = std::array<float, 2>;
using Index3 = std::array<uint32_t, 3>;

struct Mesh {
    Double3 center = {0, 0, 0};          // model space, added to every position
    std::vector<Float3> positions;       // relative to `center`, in model units
    std::vector<Index3> triangles;       // counter-clockwise seen from outside
    std::vector<Float3> corner_normals;  // three per triangle, unit length
    std::vector<Float2> corner_uvs;      // three per triangle
    uint32_t own_triangles = 0xffffffff; // that many are the model's own surface; the rest are faces of earlier cuts
};

// What the kernels need beside the triangles. Edges run from the lower to the higher vertex index.
struct MeshTopology {
    std::vector<std::array<uint32_t, 2>> edges;
    std::vector<Index3> triangle_edges; // edge k of a triangle joins its corners k and (k + 1) % 3
    std::vector<uint32_t>
        half_edge_mates; // 3 per triangle: half-edge 3t+k lies against half-edge mates[3t+k], which runs the
                         // other way; where more than two triangles meet, neighbors around the edge are paired
};

// Measures in double precision, by the divergence theorem.
struct MeshMeasures {
    double volume = 0;
    double area = 0;
    double diagonal = 0;          // of the box
    Double3 centroid = {0, 0, 0}; // relative to the mesh's center
};

} // namespace brittle
