#include "modules/brittle/mesh/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace brittle {

void TriangleTree::Bounds::grow(const Bounds& other) {
    for (size_t c = 0; c < 3; ++c) {
        lower[c] = std::min(lower[c], other.lower[c]);
        upper[c] = std::max(upper[c], other.upper[c]);
    }
}

// Slabs, a little wider than they are: a box missed by rounding would be a crossing lost.
bool TriangleTree::Bounds::isMetBy(const Double3& origin, const Double3& inverse_direction) const {
    double enter = 0, leave = HUGE_VAL;
    for (size_t c = 0; c < 3; ++c) {
        const double a = (static_cast<double>(lower[c]) - origin[c]) * inverse_direction[c];
        const double b = (static_cast<double>(upper[c]) - origin[c]) * inverse_direction[c];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave * (1 + 1e-12) + 1e-300;
}

namespace {

std::vector<TriangleTree::Bounds> boundsOfTriangles(const Mesh& mesh) {
    std::vector<TriangleTree::Bounds> bounds(mesh.triangles.size());
    for (size_t t = 0; t < bounds.size(); ++t)
        for (const uint32_t v : mesh.triangles[t])
            bounds[t].grow({mesh.positions[v], mesh.positions[v]});
    return bounds;
}

} // namespace

TriangleTree::TriangleTree(const Mesh& mesh) : TriangleTree(boundsOfTriangles(mesh)) {}

TriangleTree::TriangleTree(std::vector<Bounds> bounds) : bounds_(std::move(bounds)), order_(bounds_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(bounds_.size() + 1);
    build(0, static_cast<uint32_t>(order_.size()));
}

// Halves by the middle triangle along the longest side. The depth is that of a balanced tree.
uint32_t TriangleTree::build(uint32_t first, uint32_t count) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    Node node;
    node.first = first;
    node.count = count;
    for (uint32_t k = first; k < first + count; ++k)
        node.bounds.grow(bounds_[order_[k]]);
    nodes_.push_back(node);
    if (count <= kLeafSize) return index;
    size_t axis = 0;
    for (size_t c = 1; c < 3; ++c)
        if (node.bounds.upper[c] - node.bounds.lower[c] > node.bounds.upper[axis] - node.bounds.lower[axis]) axis = c;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](uint32_t a, uint32_t b) {
        return bounds_[a].lower[axis] + bounds_[a].upper[axis] < bounds_[b].lower[axis] + bounds_[b].upper[axis];
    });
    build(first, count / 2);
    nodes_[index].right = build(first + count / 2, count - count / 2);
    return index;
}

} // namespace brittle
