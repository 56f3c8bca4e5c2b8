#include "modules/brittle/fracture/wedges.h"

namespace brittle {

// Places on the grid, of at most 24 bits, are floats.
void SnappedMesh::addVertex(const Int3& place) {
    const Float3 at = {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
    places_.push_back(welder_.indexOf(at, mesh_.positions));
}

void SnappedMesh::addTriangle(const Index3& corners) {
    const uint32_t a = places_[corners[0]], b = places_[corners[1]], c = places_[corners[2]];
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
}

bool SnappedMesh::touchesItself() const { return brittle::touchesItself(buildTopology(mesh_)); }

bool touchesOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid) {
    SnappedMesh snapped(mesh.positions.size());
    for (const Float3& p : mesh.positions)
        snapped.addVertex(snapToGrid(grid, {p[0], p[1], p[2]}));
    if (!snapped.hasLostVertices()) return touchesItself(topology);
    for (const Index3& corners : mesh.triangles)
        snapped.addTriangle(corners);
    return snapped.touchesItself();
}

} // namespace brittle
