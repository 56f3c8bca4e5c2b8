#include "tests/support/shapes.h"

#include <utility>

namespace support {

using reference::operator+;
using reference::Point;
using reference::Triangle;
using reference::Triangles;

Triangles boxTriangles(const Point& lower, const Point& upper) {
    Triangles triangles;
    for (size_t axis = 0; axis < 3; ++axis)
        for (const bool at_upper : {false, true}) {
            const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<Point, 4> ring;
            for (size_t k = 0; k < 4; ++k) {
                ring[k][axis] = at_upper ? upper[axis] : lower[axis];
                ring[k][u] = k == 1 || k == 2 ? upper[u] : lower[u];
                ring[k][v] = k >= 2 ? upper[v] : lower[v];
            }
            if (!at_upper) std::swap(ring[1], ring[3]);
            triangles.push_back({ring[0], ring[1], ring[2]});
            triangles.push_back({ring[0], ring[2], ring[3]});
        }
    return triangles;
}

Triangles turnedOver(const Triangles& triangles) {
    Triangles turned;
    for (const Triangle& t : triangles)
        turned.push_back({t[0], t[2], t[1]});
    return turned;
}

Triangles joined(Triangles first, const Triangles& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

BrokenBox brokenBox() {
    const Point frame = {10, 20, 30};
    const Triangles left = boxTriangles({0, 0, 0}, {1, 1, 1}), right = boxTriangles({1, 0, 0}, {2, 1, 1});
    BrokenBox broken;
    broken.model = boxTriangles(frame, frame + Point{2, 1, 1});
    reference::Piece a{"fragment_0000", frame, frame + Point{.5, .5, .5}, 0, 1, {}, {}};
    reference::Piece b{"fragment_0001", frame, frame + Point{1.5, .5, .5}, 1, 1, {}, {}};
    a.inner.assign(left.begin() + 2, left.begin() + 4);
    a.outer = joined({left[0], left[1]}, Triangles(left.begin() + 4, left.end()));
    b.inner = turnedOver(a.inner);
    b.outer.assign(right.begin() + 2, right.end());
    broken.file.pieces = {a, b};
    return broken;
}

} // namespace support
