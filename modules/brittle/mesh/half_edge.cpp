#include "modules/brittle/mesh/half_edge.h"

namespace brittle {

EdgeUses::EdgeUses(const MeshTopology& topology)
    : edge_of_(3 * topology.triangle_edges.size()), first_(topology.edges.size() + 1, 0), half_edges_(edge_of_.size()) {
    for (uint32_t h = 0; h < edge_of_.size(); ++h) {
        edge_of_[h] = topology.triangle_edges[h / 3][h % 3];
        ++first_[edge_of_[h] + 1];
    }
    for (size_t e = 1; e < first_.size(); ++e)
        first_[e] += first_[e - 1];
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t h = 0; h < edge_of_.size(); ++h)
        half_edges_[next[edge_of_[h]]++] = h;
}

uint32_t EdgeUses::across(uint32_t h) const {
    const std::span<const uint32_t> both = along(edge_of_[h]);
    if (both.size() != 2) return h;
    return both[0] == h ? both[1] : both[0];
}

} // namespace brittle
