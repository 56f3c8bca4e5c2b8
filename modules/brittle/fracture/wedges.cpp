#include "modules/brittle/fracture/wedges.h"

namespace brittle {
namespace {

// Goes from triangle to triangle.
bool hasSeveralParts(const MeshTopology& topology) {
    const std::vector<uint32_t>& mates = topology.half_edge_mates;
    std::vector<bool> met(mates.size() / 3, false);
    std::vector<uint32_t> waiting = {0};
    size_t count = 0;
    while (!waiting.empty() && !met.empty()) {
        const uint32_t t = waiting.back();
        waiting.pop_back();
        if (met[t]) continue;
        met[t] = true;
        ++count;
        for (uint32_t h = 3 * t; h < 3 * t + 3; ++h)
            if (mates[h] != kNoMate) waiting.push_back(mates[h] / 3);
    }
    return count < met.size();
}

bool mayTouch(const MeshTopology& topology) { return touchesItself(topology) || hasSeveralParts(topology); }

} // namespace

// Places on the grid, of at most 24 bits, are floats.
void SnappedMesh::addVertex(const Int3& place) {
    const Float3 at = {static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
    places_.push_back(welder_.indexOf(at, mesh_.positions));
}

void SnappedMesh::addTriangle(const Index3& corners) {
    const uint32_t a = places_[corners[0]], b = places_[corners[1]], c = places_[corners[2]];
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
}

bool SnappedMesh::mayTouchItself() const { return brittle::mayTouch(buildTopology(mesh_)); }

bool mayTouchOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid) {
    SnappedMesh snapped(mesh.positions.size());
    for (const Float3& p : mesh.positions)
        snapped.addVertex(snapToGrid(grid, {p[0], p[1], p[2]}));
    if (!snapped.hasLostVertices()) return mayTouch(topology);
    for (const Index3& corners : mesh.triangles)
        snapped.addTriangle(corners);
    return snapped.mayTouchItself();
}

} // namespace brittle
