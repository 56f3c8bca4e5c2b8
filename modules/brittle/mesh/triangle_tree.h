// A tree of boxes over the triangles of a mesh: finds triangles near each other and along rays.
#pragma once

#include "modules/brittle/mesh/vector_math.h"

#include <span>

namespace brittle {

class TriangleTree {
public:
    struct Bounds { // floats like the positions, so exact
        Float3 lower = {3e38f, 3e38f, 3e38f}, upper = {-3e38f, -3e38f, -3e38f};
        void grow(const Bounds& other);
        bool touches(const Bounds& other) const;
        bool isMetBy(const Double3& origin, const Double3& inverse_direction) const;
    };

    explicit TriangleTree(const Mesh& mesh);
    // Over boxes of anything else, which then stands for the triangles.
    explicit TriangleTree(std::vector<Bounds> bounds);

    // Calls visit(a, b), a < b, once for every pair whose boxes touch; stops as soon as visit returns false.
    template <class Visit>
    void forEachPair(const Visit& visit) const;

    // Calls visit(t) for every triangle whose box the line origin + s * direction, s >= 0, meets.
    template <class Visit>
    void forEachAlong(const Double3& origin, const Double3& direction, const Visit& visit) const;

private:
    struct Node {
        Bounds bounds;
        uint32_t first = 0, count = 0; // triangles in order_, of leaves
        uint32_t right = 0;            // left child is the next node; 0 for leaves
    };
    static constexpr uint32_t kLeafSize = 4;

    uint32_t build(uint32_t first, uint32_t count);
    template <class Visit>
    bool visitLeaves(const Node& a, const Node& b, const Visit& visit) const;

    std::vector<Bounds> bounds_;  // of every triangle
    std::vector<uint32_t> order_; // triangles, leaf by leaf
    std::vector<Node> nodes_;     // root first
};

inline bool TriangleTree::Bounds::touches(const Bounds& other) const {
    return lower[0] <= other.upper[0] && lower[1] <= other.upper[1] && lower[2] <= other.upper[2] &&
           other.lower[0] <= upper[0] && other.lower[1] <= upper[1] && other.lower[2] <= upper[2];
}

template <class Visit>
bool TriangleTree::visitLeaves(const Node& a, const Node& b, const Visit& visit) const {
    for (uint32_t i = 0; i < a.count; ++i)
        for (uint32_t j = &a == &b ? i + 1 : 0; j < b.count; ++j) {
            const uint32_t s = order_[a.first + i], t = order_[b.first + j];
            if (bounds_[s].touches(bounds_[t]) && !visit(s < t ? s : t, s < t ? t : s)) return false;
        }
    return true;
}

template <class Visit>
void TriangleTree::forEachPair(const Visit& visit) const {
    std::vector<std::array<uint32_t, 2>> waiting = {{0, 0}};
    while (!waiting.empty()) {
        const auto [i, j] = waiting.back();
        waiting.pop_back();
        const Node &a = nodes_[i], &b = nodes_[j];
        if (!a.bounds.touches(b.bounds)) continue;
        if (a.right == 0 && b.right == 0) {
            if (!visitLeaves(a, b, visit)) return;
        } else if (i == j) {
            waiting.insert(waiting.end(), {{i + 1, i + 1}, {a.right, a.right}, {i + 1, a.right}});
        } else if (b.right == 0 || (a.right != 0 && a.count >= b.count)) {
            waiting.insert(waiting.end(), {{i + 1, j}, {a.right, j}});
        } else {
            waiting.insert(waiting.end(), {{i, j + 1}, {i, b.right}});
        }
    }
}

template <class Visit>
void TriangleTree::forEachAlong(const Double3& origin, const Double3& direction, const Visit& visit) const {
    const Double3 inverse = {1 / direction[0], 1 / direction[1], 1 / direction[2]};
    std::vector<uint32_t> waiting = {0};
    while (!waiting.empty()) {
        const uint32_t i = waiting.back();
        waiting.pop_back();
        const Node& node = nodes_[i];
        if (!node.bounds.isMetBy(origin, inverse)) continue;
        if (node.right != 0) waiting.insert(waiting.end(), {i + 1, node.right});
        for (uint32_t k = 0; node.right == 0 && k < node.count; ++k)
            visit(order_[node.first + k]);
    }
}

} // namespace brittle
