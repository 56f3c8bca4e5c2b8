#include "modules/brittle/collision/collider.h"

#include "modules/brittle/mesh/vector_math.h"

#include <string>

namespace brittle {

ColliderBody wholeBody(const ColliderSet& colliders) { return {0, static_cast<uint32_t>(colliders.pieces.size())}; }

engine::Result<ColliderBody> bodyOf(const ColliderSet& colliders, uint32_t fragment) {
    if (fragment >= colliders.pieces.size())
        return engine::Error{engine::ErrorCode::BadInput,
                             "fragment " + std::to_string(fragment) + " has no collider: there are " +
                                 std::to_string(colliders.pieces.size()) + "; ask for colliders when breaking"};
    return ColliderBody{fragment, 1};
}

std::vector<uint32_t> trianglesOf(const ColliderSet& colliders, const ColliderPiece& piece) {
    std::vector<uint32_t> triangles;
    for (uint32_t k = 0; k < piece.face_count; ++k) {
        const ColliderFace& face = colliders.faces[piece.first_face + k];
        const uint32_t* loop = colliders.corners.data() + face.first_corner;
        for (uint32_t c = 1; c + 1 < face.corner_count; ++c)
            triangles.insert(triangles.end(), {loop[0], loop[c], loop[c + 1]});
    }
    return triangles;
}

double volumeOf(const ColliderSet& colliders, const ColliderPiece& piece) {
    if (piece.vertex_count == 0) return 0;
    const Float3* vertices = colliders.vertices.data() + piece.first_vertex;
    const Double3 origin = toDouble(vertices[0]); // one of its own: far from the center a small piece keeps its digits
    const std::vector<uint32_t> triangles = trianglesOf(colliders, piece);
    double six_volumes = 0;
    for (size_t k = 0; k < triangles.size(); k += 3) {
        const Double3 a = toDouble(vertices[triangles[k]]) - origin, b = toDouble(vertices[triangles[k + 1]]) - origin,
                      c = toDouble(vertices[triangles[k + 2]]) - origin;
        six_volumes += dot(a, cross(b, c));
    }
    return six_volumes / 6;
}

} // namespace brittle
