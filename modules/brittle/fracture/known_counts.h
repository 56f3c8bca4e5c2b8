// What the device is told of an event whose mesh and sites the host knows: their counts, and the grids of the dispatches over
// them, as kernels would have published both (shaders-spirv/lib/publish.glsl).
#pragma once

#include "modules/brittle/fracture/upload.h"
#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/fracture.h"

#include <array>
#include <cstdint>

namespace brittle {

// Words of dispatch arguments of a count: a lane an element, a workgroup SCAN_BLOCK elements, a workgroup an element.
constexpr uint32_t kArgumentWords = 9;

// Of so many elements, where workgroups of a lane an element have `group_size` lanes.
std::array<uint32_t, kArgumentWords> argumentsOf(uint32_t count, uint32_t group_size);

// Those from kFirst to the last one: they lie in a row, so that each kind goes up in one piece.
struct KnownCounts {
    static constexpr uint32_t kFirst = COUNT_MESH_VERTICES, kTotal = COUNT_BINS - COUNT_MESH_VERTICES + 1;
    std::array<uint32_t, kTotal> counts{};
    std::array<uint32_t, size_t{kArgumentWords} * kTotal> args{};
    // To the buffers of counts and of dispatch arguments; lives until the upload buffer is filled.
    void addTo(Upload& upload, const engine::BufferView& to_counts, const engine::BufferView& to_args) const;
};
KnownCounts knownCounts(const Mesh& mesh, const MeshTopology& topology, uint32_t sites, uint32_t bins, uint32_t group_size);

} // namespace brittle
