#include "tests/kernel/clipped_polygons.h"

#include "tests/reference/predicates.h"

namespace kernel_test {
namespace {

// Values of a side's line at the triangle's corners.
Weights lineOf(const Polygons& p, uint32_t triangle, uint32_t cell, uint32_t side) {
    Weights line = {0, 0, 0};
    if (side >= EDGE_BASE) {
        line[(side - EDGE_BASE + 2) % 3] = 1;
        return line;
    }
    for (size_t k = 0; k < 3; ++k)
        line[k] = static_cast<long double>(reference::nearness(p.sites[cell], p.sites[side], p.corner(triangle, k)));
    return line;
}

} // namespace

Weights meetingPoint(const Polygons& p, uint32_t triangle, uint32_t cell, uint32_t side, uint32_t other) {
    const Weights a = lineOf(p, triangle, cell, side), b = lineOf(p, triangle, cell, other);
    Weights w = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const long double sum = w[0] + w[1] + w[2];
    for (long double& x : w)
        x /= sum;
    return w;
}

std::vector<Weights> cornersOf(const Polygons& p, uint32_t q) {
    std::vector<Weights> corners;
    for (uint32_t k = 0; k < p.sideCount(q); ++k)
        corners.push_back(meetingPoint(p, p.polygons[q][0], p.polygons[q][1], p.side(q, k), p.side(q, k + 1)));
    return corners;
}

LongPoint placeOf(const Polygons& p, uint32_t triangle, const Weights& weights) {
    LongPoint place = {0, 0, 0};
    for (size_t k = 0; k < 3; ++k)
        for (size_t axis = 0; axis < 3; ++axis)
            place[axis] += weights[k] * p.corner(triangle, k)[axis];
    return place;
}

} // namespace kernel_test
