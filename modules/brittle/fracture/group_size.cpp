#include "modules/brittle/fracture/group_size.h"

#include <algorithm>
#include <bit>
#include <string>

namespace brittle {

engine::Result<void> checkGroupSize(uint32_t size, const VkPhysicalDeviceLimits& limits) {
    const uint32_t most = std::min({256u, limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0]});
    if (std::has_single_bit(size) && size >= 8 && size <= most) return {};
    return engine::Error{engine::ErrorCode::BadInput, "workgroups of " + std::to_string(size) +
                                                          " lanes; give a power of two from 8 to " +
                                                          std::to_string(std::bit_floor(most))};
}

} // namespace brittle
