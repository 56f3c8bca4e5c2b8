// The surfaces of a world's bodies. All of them together may take more bytes than a device can bind at once. So kernels take
// the list part by part, and no surface lies in two parts (surface_places.h).
#pragma once

#include "engine/buffer.h"
#include "modules/brittle/fracture/fragments.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace brittle {

struct SurfacePart {
    engine::BufferView vertices; // SceneVertex
    // Numbers of its vertices in the whole list; a push constant of kernels.
    struct Vertices {
        uint32_t first = 0, end = 0;
    } range;
};

struct SurfaceList {
    engine::BufferView vertices; // SceneVertex, three a triangle
    uint32_t part_triangles = 0; // of each part but the last; 0: there is only one part

    SurfaceList() = default;
    // Without `triangles_of_part` the list is one part.
    SurfaceList(engine::BufferView all, uint32_t triangles_of_part = 0) : vertices(all), part_triangles(triangles_of_part) {}

    uint32_t vertexCount() const { return static_cast<uint32_t>(vertices.size / sizeof(FragmentVertex)); }
    uint32_t partCount() const {
        return part_triangles == 0 ? 1 : (std::max(vertexCount(), 1u) - 1) / (3 * part_triangles) + 1;
    }
    std::vector<SurfacePart> parts() const {
        constexpr uint64_t kBytes = sizeof(FragmentVertex);
        std::vector<SurfacePart> list;
        for (uint32_t k = 0; k < partCount(); ++k) {
            const bool is_last = k + 1 == partCount();
            const uint32_t first = 3 * part_triangles * k, end = is_last ? vertexCount() : first + 3 * part_triangles;
            const uint64_t bytes = is_last ? vertices.size - kBytes * first : kBytes * (end - first);
            list.push_back({vertices.sub(kBytes * first, bytes), {first, end}});
        }
        return list;
    }
};

} // namespace brittle
