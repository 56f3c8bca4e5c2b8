#include "modules/brittle/dynamics/piece_shape.h"

#include "modules/brittle/mesh/vector_math.h"

namespace brittle {

PieceShape pieceOf(const ConvexHull& hull, const Double3& center) {
    PieceShape piece;
    for (const Double3& v : hull.vertices)
        piece.vertices.push_back(toFloat(v - center));
    for (const ConvexHull::Face& face : hull.faces)
        piece.loops.emplace_back(hull.corners.begin() + face.first_corner,
                                 hull.corners.begin() + face.first_corner + face.corner_count);
    return piece;
}

PieceShape pieceOf(const ColliderSet& set, const ColliderPiece& piece, const Double3& center) {
    PieceShape shape;
    for (uint32_t v = 0; v < piece.vertex_count; v++)
        shape.vertices.push_back(toFloat(toDouble(set.vertices[piece.first_vertex + v]) - center));
    for (uint32_t f = 0; f < piece.face_count; f++) {
        const ColliderFace& face = set.faces[piece.first_face + f];
        shape.normals.push_back(face.normal);
        shape.loops.emplace_back(set.corners.begin() + face.first_corner,
                                 set.corners.begin() + face.first_corner + face.corner_count);
    }
    return shape;
}

} // namespace brittle
