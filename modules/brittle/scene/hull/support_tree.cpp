#include "modules/brittle/scene/hull/support_tree.h"

#include <algorithm>

namespace brittle {
namespace {

constexpr uint32_t kLeaf = 16;

size_t longestEdge(const Box& box) {
    const Double3 size = box.upper - box.lower;
    return static_cast<size_t>(std::max_element(size.begin(), size.end()) - size.begin());
}

} // namespace

SupportTree::SupportTree(std::span<const Double3> points) : points_(points.begin(), points.end()) {
    if (!points_.empty()) grow(0, static_cast<uint32_t>(points_.size()));
}

uint32_t SupportTree::grow(uint32_t first, uint32_t count) {
    const auto begin = points_.begin() + first, middle = begin + count / 2, end = begin + count;
    const auto node = static_cast<uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, count, 0, 0});
    std::for_each(begin, end, [&](const Double3& p) { nodes_[node].box.grow(p); });
    if (count <= kLeaf) return node;
    const size_t axis = longestEdge(nodes_[node].box);
    std::nth_element(begin, middle, end, [axis](const Double3& a, const Double3& b) { return a[axis] < b[axis]; });
    const uint32_t left = grow(first, count / 2), right = grow(first + count / 2, count - count / 2);
    nodes_[node].left = left;
    nodes_[node].right = right;
    return node;
}

// The box's corner that is furthest along. Rounding keeps order, and `dot` rounds both alike: no point in the box is beyond.
double SupportTree::reach(uint32_t node, const Double3& direction) const {
    const Box& box = nodes_[node].box;
    Double3 corner = box.lower;
    for (size_t c = 0; c < 3; ++c)
        if (direction[c] > 0) corner[c] = box.upper[c];
    return dot(direction, corner);
}

void SupportTree::raise(uint32_t node, const Double3& direction, double& most) const {
    const Node& n = nodes_[node];
    if (n.left == 0) {
        for (uint32_t k = n.first; k < n.first + n.count; ++k)
            most = std::max(most, dot(direction, points_[k]));
        return;
    }
    const double left = reach(n.left, direction), right = reach(n.right, direction);
    const uint32_t further = left >= right ? n.left : n.right, nearer = left >= right ? n.right : n.left;
    if (std::max(left, right) > most) raise(further, direction, most);
    if (std::min(left, right) > most) raise(nearer, direction, most);
}

double SupportTree::support(const Double3& direction) const {
    double most = -1e300;
    if (!nodes_.empty()) raise(0, direction, most);
    return most;
}

} // namespace brittle
