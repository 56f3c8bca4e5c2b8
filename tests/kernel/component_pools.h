// Components laid out as split_islands leaves them, made of plain triangles, and the kernels that measure and judge them.
#pragma once

#include "shaders-spirv/shared/fragment_record.h"
#include "tests/kernel/lab.h"
#include "tests/reference/geometry.h"

namespace kernel_test {

struct Component {
    reference::Triangles triangles;
    uint32_t cell = 0;
    size_t outer = SIZE_MAX; // so many triangles, the first ones, are the model's surface; the rest are caps
};

struct Judged {
    std::vector<brittle::FragmentRecord> records;
    std::vector<Word2> fates; // fate, the component it belongs to
    uint32_t films = 0, cavities = 0, bad = 0;
};

// Triangles of all components lie mixed up in memory; only their order tells them apart.
Judged judgeOnDevice(const std::vector<Component>& components, float grid_step);

} // namespace kernel_test
