#include "modules/brittle/fracture/wedges.h"

#include "modules/brittle/mesh/welder.h"

#include <utility>

namespace brittle {
namespace {

// The mesh on the grid: vertices of one place are one, and triangles with fewer than three places are left out.
struct SnappedMesh {
    Mesh mesh;
    std::vector<uint32_t> triangles; // of the original
};

// Places on the grid, of at most 24 bits, are floats. `index` leads from the original's vertices to those that are left.
std::vector<Float3> snapVertices(const Mesh& mesh, const EventGrid& grid, std::vector<uint32_t>& index) {
    std::vector<Float3> places;
    Welder welder(mesh.positions.size());
    for (const Float3& p : mesh.positions) {
        const Int3 at = snapToGrid(grid, {p[0], p[1], p[2]});
        index.push_back(
            welder.indexOf({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])}, places));
    }
    return places;
}

SnappedMesh snappedMesh(const Mesh& mesh, std::vector<Float3> places, const std::vector<uint32_t>& index) {
    SnappedMesh snapped;
    snapped.mesh.positions = std::move(places);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Index3 corners = {index[a], index[b], index[c]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        snapped.mesh.triangles.push_back(corners);
        snapped.triangles.push_back(t);
    }
    return snapped;
}

} // namespace

std::vector<uint32_t> wedgesOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid) {
    std::vector<uint32_t> index;
    std::vector<Float3> places = snapVertices(mesh, grid, index);
    const bool is_as_it_is = places.size() == mesh.positions.size();
    if (is_as_it_is && !touchesItself(topology)) return {};
    const SnappedMesh snapped = snappedMesh(mesh, std::move(places), index);
    const MeshTopology on_grid = buildTopology(snapped.mesh);
    if (!touchesItself(on_grid)) return {};
    const std::vector<uint32_t> found = wedgesOf(on_grid);
    std::vector<uint32_t> wedges(3 * mesh.triangles.size(), kNoMate);
    for (uint32_t h = 0; h < found.size(); ++h)
        if (found[h] != kNoMate)
            wedges[3 * snapped.triangles[h / 3] + h % 3] = 3 * snapped.triangles[found[h] / 3] + found[h] % 3;
    return wedges;
}

} // namespace brittle
