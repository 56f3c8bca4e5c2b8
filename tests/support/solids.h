// Imported solids put together into larger ones.
#pragma once

#include "modules/brittle/mesh/import.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

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

// A prism over an outline, counterclockwise, whose caps are cut into triangles from the first corner.
inline brittle::ImportedMesh fanPrism(const std::vector<std::array<double, 2>>& outline, double height) {
    brittle::ImportedMesh prism;
    const auto n = static_cast<uint32_t>(outline.size());
    for (const double z : {0.0, height})
        for (const auto& [x, y] : outline)
            prism.positions.push_back({x, y, z});
    for (uint32_t k = 0; k < n; ++k) {
        const uint32_t next = (k + 1) % n;
        prism.triangles.push_back({k, next, n + next});
        prism.triangles.push_back({k, n + next, n + k});
    }
    for (uint32_t k = 1; k + 1 < n; ++k) {
        prism.triangles.push_back({0, k + 1, k});
        prism.triangles.push_back({n, n + k, n + k + 1});
    }
    prism.corner_normals.resize(3 * prism.triangles.size());
    prism.corner_uvs.resize(3 * prism.triangles.size());
    return prism;
}

} // namespace support
