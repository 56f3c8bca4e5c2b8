// The broad phase on the device, for tests: boxes in, pairs and what the counts say out.
#pragma once

#include "modules/brittle/dynamics/broad_phase.h"
#include "tests/kernel/lab.h"
#include "tests/reference/boxes.h"

#include <optional>

namespace kernel_test {

using Boxes = std::vector<reference::SolidBox>;
using Pairs = std::vector<std::array<uint32_t, 2>>;

struct FoundPairs {
    Pairs pairs;
    uint32_t failed = 0;       // STATUS_FAILED
    uint32_t needed_pairs = 0; // STATUS_NEEDED of the pairs
    uint32_t needed_boxes = 0;
    std::vector<uint32_t> args; // of the pairs
};

struct BroadPhaseRun {
    uint32_t box_capacity = 0;  // 0: as many as there are
    uint32_t pair_capacity = 0; // 0: as many as the reference finds, and one
    brittle::BoxSort sort = brittle::BoxSort::OneGroup;
    engine::KernelLibrary* library = nullptr; // null: that of all tests
    uint32_t failed_before = 0;
};

// Boxes as the kernels take them: two uvec4 each.
struct DeviceBoxes {
    engine::Buffer low, high;
};
DeviceBoxes upload(const Boxes& boxes, size_t room);

FoundPairs pairsOnDevice(const Boxes& boxes, const BroadPhaseRun& run = {});

} // namespace kernel_test
