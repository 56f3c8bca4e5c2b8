#include "tests/support/mover.h"

#include "modules/brittle/dynamics/sector_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace support {

void moveTo(gpu::BodyState& state, const brittle::Double3& place) {
    constexpr double kFurthest = 1e6; // m
    if (!std::ranges::all_of(place, [](double x) { return std::fabs(x) < kFurthest; })) {
        state.offset.x = std::numeric_limits<float>::quiet_NaN();
        return;
    }
    const brittle::SectorPlace at = brittle::inSectors(place);
    state.sector = {at.sector.x, at.sector.y, at.sector.z, state.sector.w};
    state.offset = {at.offset[0], at.offset[1], at.offset[2], state.offset.w};
}

} // namespace support
