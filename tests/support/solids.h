// Imported solids put together into larger ones.
#pragma once

#include "modules/brittle/mesh/import.h"

#include <cstdint>
#include <utility>

namespace support {

inline brittle::ImportedMesh moved(brittle::ImportedMesh mesh, double scale, const brittle::Double3& by) {
    for (brittle::Double3& p : mesh.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] = scale * p[k] + by[k];
    return mesh;
}

inline brittle::ImportedMesh turnedOver(brittle::ImportedMesh mesh) {
    for (brittle::Index3& t : mesh.triangles)
        std::swap(t[1], t[2]);
    return mesh;
}

inline brittle::ImportedMesh operator+(brittle::ImportedMesh a, const brittle::ImportedMesh& b) {
    const auto first = static_cast<uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const brittle::Index3& t : b.triangles)
        a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    a.corner_normals.resize(3 * a.triangles.size());
    a.corner_uvs.resize(3 * a.triangles.size());
    return a;
}

} // namespace support
