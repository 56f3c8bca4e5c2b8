// Grows a sphere tree over binned sites on the device.
#pragma once

#include "tests/kernel/device_cells.h"

namespace kernel_test {

struct DeviceTree {
    engine::Buffer nodes, leaf_start, leaf_sites;
};
DeviceTree growTree(const std::vector<Int4>& bin_sites, uint32_t levels);

} // namespace kernel_test
