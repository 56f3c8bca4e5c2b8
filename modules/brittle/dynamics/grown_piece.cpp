#include "modules/brittle/dynamics/grown_piece.h"

#include "modules/brittle/dynamics/piece_shape.h"
#include "modules/brittle/mesh/vector_math.h"
#include "modules/brittle/scene/hull/convex_hull.h"

#include <Eigen/Dense>

namespace brittle {
namespace {

// Where the planes through a corner meet once all of them have moved by 1: of more than three planes as near to all as can be.
Double3 wayOf(const std::vector<Float3>& normals) {
    Eigen::Matrix3d squares = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Float3& n : normals) {
        const Eigen::Vector3d normal(n[0], n[1], n[2]);
        squares += normal * normal.transpose();
        sum += normal;
    }
    const Eigen::Vector3d way = squares.ldlt().solve(sum);
    return {way.x(), way.y(), way.z()};
}

} // namespace

engine::Result<PieceShape> grownPiece(const ColliderSet& set, const ColliderPiece& piece, const Double3& center, double grow) {
    std::vector<std::vector<Float3>> normals(piece.vertex_count);
    for (uint32_t f = piece.first_face; f < piece.first_face + piece.face_count; f++)
        for (uint32_t k = 0; k < set.faces[f].corner_count; k++)
            normals[set.corners[set.faces[f].first_corner + k]].push_back(set.faces[f].normal);
    std::vector<Double3> points;
    for (uint32_t v = 0; v < piece.vertex_count; v++)
        points.push_back(toDouble(set.vertices[piece.first_vertex + v]) - center + grow * wayOf(normals[v]));
    const auto hull = hullOfPoints(points);
    if (!hull) return hull.error();
    return pieceOf(hull->hull, {0, 0, 0});
}

} // namespace brittle
