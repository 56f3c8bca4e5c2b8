// Half-edge 3t + k of a mesh is corner k of triangle t and the edge from there to the next corner.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <span>

namespace brittle {

inline uint32_t nextHalfEdge(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline uint32_t previousHalfEdge(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
inline uint32_t startOf(const Mesh& mesh, uint32_t h) { return mesh.triangles[h / 3][h % 3]; }
inline uint32_t endOf(const Mesh& mesh, uint32_t h) { return mesh.triangles[h / 3][(h % 3 + 1) % 3]; }

// The half-edges along every edge, whichever way they run: one where the surface is open, two where it goes on, more where
// sheets meet. For meshes that are not (yet) sound, of which MeshTopology::half_edge_mates tells too little.
class EdgeUses {
public:
    explicit EdgeUses(const MeshTopology& topology);

    uint32_t edgeOf(uint32_t h) const { return edge_of_[h]; }
    std::span<const uint32_t> along(uint32_t edge) const { // ascending
        return std::span(half_edges_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
    }
    size_t edgeCount() const { return first_.size() - 1; }
    bool isOpen(uint32_t h) const { return along(edge_of_[h]).size() == 1; }
    // The other one of an edge that has two, `h` itself elsewhere.
    uint32_t across(uint32_t h) const;

private:
    std::vector<uint32_t> edge_of_, first_, half_edges_;
};

} // namespace brittle
