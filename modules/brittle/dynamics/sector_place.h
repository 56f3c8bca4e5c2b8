// A place as the device has it: a sector of space and an offset from its middle (shaders-spirv/shared/body.h).
#pragma once

#include "modules/brittle/mesh/mesh.h"
#include "shaders-spirv/shared/body.h"

#include <cmath>

namespace brittle {

struct SectorPlace {
    gpu::ivec4 sector = {0, 0, 0, 0};
    Float3 offset = {0, 0, 0};
};

// Of a place within 1e6 m.
inline SectorPlace inSectors(const Double3& place) {
    SectorPlace result;
    int32_t* const sector[] = {&result.sector.x, &result.sector.y, &result.sector.z};
    for (size_t k = 0; k < 3; ++k) {
        const double steps = std::floor(place[k] / SECTOR_EDGE + 0.5);
        *sector[k] = static_cast<int32_t>(steps);
        result.offset[k] = static_cast<float>(place[k] - steps * SECTOR_EDGE);
    }
    return result;
}

inline Double3 placeOf(const gpu::ivec4& sector, const gpu::vec4& offset) {
    const double edge = SECTOR_EDGE;
    return {edge * sector.x + offset.x, edge * sector.y + offset.y, edge * sector.z + offset.z};
}

} // namespace brittle
