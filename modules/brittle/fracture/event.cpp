#include "modules/brittle/fracture/event.h"

#include <algorithm>

namespace brittle {

// A subgroup of a CPU device has 65,535 turns for all its lanes; a GPU has no such limit. Fetching all sites and going through
// them, which the lanes do together, takes its part of them.
uint32_t turnBudget(const engine::Device& device, uint32_t group_size, Search search, uint32_t sites) {
    const uint32_t together = search == Search::Linear ? 2 * (sites / LINEAR_AT_ONCE + sites / group_size + 2) : 0;
    return device.isCpu() ? (60'000 - together) / device.subgroupSize() : 1u << 20;
}

uint32_t sourceWindow(const VkPhysicalDeviceLimits& limits) {
    constexpr uint64_t kBytes = 15 * sizeof(float), kTogether = 64; // of which parts are whole multiples of 256 bytes
    return static_cast<uint32_t>(std::min<uint64_t>(limits.maxStorageBufferRange / kBytes, 1u << 30) / kTogether * kTogether);
}

// Whose vertices one binding can hold; whole multiples of any alignment of views.
uint32_t emitWindow(const VkPhysicalDeviceLimits& limits) {
    const uint64_t fit = uint64_t{limits.maxStorageBufferRange} / (3 * sizeof(FragmentVertex));
    return static_cast<uint32_t>(std::min<uint64_t>(fit, 1u << 28)) / 256 * 256;
}

void recordFracture(const Event& e) {
    recordSites(e);
    const uint32_t rounds = e.placement != nullptr ? e.placement->options.relax : 0;
    for (uint32_t round = 0; round < rounds; round++)
        recordRelaxation(e);
    if (e.search == Search::SphereTree) recordSphereTree(e);
    recordCells(e);
    if (e.only_cells) return;
    if (e.capacity.touching) recordWedges(e);
    recordClassification(e);
    recordClipping(e);
    recordPlaces(e);
    recordDepth(e);
    recordCaps(e);
    recordIslands(e);
    recordMassProperties(e);
    recordEmission(e);
    if (e.capacity.collider_directions != 0) recordColliders(e);
}

} // namespace brittle
