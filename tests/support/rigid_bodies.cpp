#include "tests/support/rigid_bodies.h"

namespace support {

brittle::PieceShape boxPiece(const brittle::Double3& size) {
    brittle::PieceShape piece;
    for (uint32_t k = 0; k < 8; ++k) {
        brittle::Float3 v;
        for (size_t axis = 0; axis < 3; ++axis)
            v[axis] = static_cast<float>((k >> axis & 1) != 0 ? size[axis] / 2 : -size[axis] / 2);
        piece.vertices.push_back(v);
    }
    piece.loops = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return piece;
}

brittle::BodyDefinition box(const brittle::Double3& size, const brittle::Double3& place, double density) {
    brittle::BodyDefinition body;
    body.name = "box";
    body.pieces = {boxPiece(size)};
    body.place = place;
    const double mass = density * size[0] * size[1] * size[2];
    body.mass = mass;
    for (size_t k = 0; k < 3; ++k) {
        const double u = size[(k + 1) % 3], v = size[(k + 2) % 3];
        body.inertia[k] = mass * (u * u + v * v) / 12;
    }
    return body;
}

brittle::BodyDefinition ground(double edge) {
    brittle::BodyDefinition body = box({edge, 2, edge}, {0, -1, 0});
    body.name = "ground";
    body.mass = 0;
    return body;
}

} // namespace support
