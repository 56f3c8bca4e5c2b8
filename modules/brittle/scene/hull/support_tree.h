// How far many points reach along a direction, to the bit what a look at all of them finds. Of points on a convex surface a
// look at few is enough: a tree of boxes, halved along their longest edges, leaves out what no longer counts.
#pragma once

#include "modules/brittle/mesh/vector_math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace brittle {

class SupportTree {
public:
    explicit SupportTree(std::span<const Double3> points);

    // The greatest dot(direction, point); -1e300 where there are no points.
    double support(const Double3& direction) const;

private:
    struct Node {
        Box box;
        uint32_t first = 0, count = 0; // of the points
        uint32_t left = 0, right = 0;  // nodes; of leaves 0
    };
    uint32_t grow(uint32_t first, uint32_t count);
    double reach(uint32_t node, const Double3& direction) const;
    void raise(uint32_t node, const Double3& direction, double& most) const;

    std::vector<Double3> points_;
    std::vector<Node> nodes_;
};

} // namespace brittle
