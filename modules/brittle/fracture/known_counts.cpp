#include "modules/brittle/fracture/known_counts.h"

#include <algorithm>

namespace brittle {

std::array<uint32_t, kArgumentWords> argumentsOf(uint32_t count, uint32_t group_size) {
    std::array<uint32_t, kArgumentWords> args;
    size_t at = 0;
    for (const uint32_t size : {group_size, uint32_t{SCAN_BLOCK}, 1u}) {
        const uint32_t groups = (count + size - 1) / size;
        args[at++] = std::min(groups, 65535u);
        args[at++] = (groups + 65534) / 65535;
        args[at++] = 1;
    }
    return args;
}

KnownCounts knownCounts(const Mesh& mesh, const MeshTopology& topology, uint32_t sites, uint32_t bins, uint32_t group_size) {
    const auto triangles = static_cast<uint32_t>(mesh.triangles.size()), own = std::min(mesh.own_triangles, triangles);
    KnownCounts known;
    const auto tell = [&](uint32_t count, uint32_t value) {
        known.counts[count - KnownCounts::kFirst] = value;
        std::ranges::copy(argumentsOf(value, group_size), known.args.begin() + kArgumentWords * (count - KnownCounts::kFirst));
    };
    tell(COUNT_MESH_VERTICES, static_cast<uint32_t>(mesh.positions.size()));
    tell(COUNT_OWN_TRIANGLES, own);
    tell(COUNT_EARLIER_TRIANGLES, triangles - own);
    tell(COUNT_MESH_TRIANGLES, triangles);
    tell(COUNT_MESH_CORNERS, 3 * triangles);
    tell(COUNT_MESH_EDGES, static_cast<uint32_t>(topology.edges.size()));
    tell(COUNT_ASKED_SITES, sites);
    tell(COUNT_BINS, bins);
    return known;
}

void KnownCounts::addTo(Upload& upload, const engine::BufferView& to_counts, const engine::BufferView& to_args) const {
    upload.add(std::span<const uint32_t>(counts), to_counts.sub(4 * kFirst, sizeof counts));
    upload.add(std::span<const uint32_t>(args), to_args.sub(4 * kArgumentWords * kFirst, sizeof args));
}

} // namespace brittle
