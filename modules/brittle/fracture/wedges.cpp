#include "modules/brittle/fracture/wedges.h"

#include <algorithm>
#include <numeric>

namespace brittle {
namespace {

// The mesh on the grid: of vertices of one place one is left, and of triangles those with three places.
struct SnappedMesh {
    Mesh mesh;
    std::vector<uint32_t> triangles; // of the original
};

std::vector<Int3> snappedPlaces(const Mesh& mesh, const EventGrid& grid) {
    std::vector<Int3> places;
    places.reserve(mesh.positions.size());
    for (const Float3& p : mesh.positions)
        places.push_back(snapToGrid(grid, {p[0], p[1], p[2]}));
    return places;
}

// Returns for every vertex the lowest one at its place.
std::vector<uint32_t> lowestAtPlace(const std::vector<Int3>& places) {
    std::vector<uint32_t> order(places.size()), lowest(places.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return places[a] != places[b] ? places[a] < places[b] : a < b; });
    for (size_t k = 0; k < order.size(); ++k) {
        const bool is_same = k > 0 && places[order[k]] == places[order[k - 1]];
        lowest[order[k]] = is_same ? lowest[order[k - 1]] : order[k];
    }
    return lowest;
}

SnappedMesh snappedMesh(const Mesh& mesh, const std::vector<Int3>& places, const std::vector<uint32_t>& lowest) {
    SnappedMesh snapped;
    for (const Int3& p : places)
        snapped.mesh.positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Index3 corners = {lowest[a], lowest[b], lowest[c]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        snapped.mesh.triangles.push_back(corners);
        snapped.triangles.push_back(t);
    }
    return snapped;
}

} // namespace

std::vector<uint32_t> wedgesOnGrid(const Mesh& mesh, const MeshTopology& topology, const EventGrid& grid) {
    const std::vector<Int3> places = snappedPlaces(mesh, grid);
    const std::vector<uint32_t> lowest = lowestAtPlace(places);
    const bool is_as_it_is =
        std::ranges::adjacent_find(lowest, [](uint32_t a, uint32_t b) { return b != a + 1; }) == lowest.end();
    if (is_as_it_is && !touchesItself(topology)) return {};
    const SnappedMesh snapped = snappedMesh(mesh, places, lowest);
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
