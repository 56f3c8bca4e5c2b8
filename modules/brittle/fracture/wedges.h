// Surfaces that may touch themselves along edges, as the grid of an event has it: more than two triangles meet at an edge, or there are
// several parts, whose edges may lie on each other.
#pragma once

#include "modules/brittle/fracture/event_grid.h"
#include "modules/brittle/mesh/topology.h"
#include "modules/brittle/mesh/welder.h"

namespace brittle {

// Vertices, one for each place on a grid, and the triangles that keep three places.
class SnappedMesh {
public:
    explicit SnappedMesh(size_t vertices) : welder_(vertices) {}

    void addVertex(const Int3& place);
    void addTriangle(const Index3& corners);
    bool hasLostVertices() const { return mesh_.positions.size() < places_.size(); }
    bool mayTouchItself() const;

private:
    Mesh mesh_;
    Welder welder_;
    std::vector<uint32_t> places_; // of the vertices that were added, their numbers in the mesh
};

bool mayTouchOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid);

} // namespace brittle
