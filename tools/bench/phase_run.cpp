#include "tools/bench/phase_run.h"

#include "shaders-spirv/shared/fracture.h"

#include <algorithm>
#include <cmath>

namespace bench {

using engine::Result;

brittle::Turn Dice::turn() {
    for (;;) {
        const brittle::Turn q = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
        const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (size > 0.1 && size < 1) return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
    }
}

engine::Buffer Buffers::make(uint64_t bytes, std::string_view name) {
    if (!status_) return {};
    auto made = engine::Buffer::create(device_, std::max<uint64_t>(bytes, 16), engine::BufferDomain::Device, 0, name);
    if (made) return std::move(*made);
    status_ = made.error();
    return {};
}

Result<double> labelMs(const engine::Commands& commands, std::string_view label) {
    const auto timings = commands.timings();
    if (!timings) return timings.error();
    double ms = 0;
    for (const engine::Timing& timing : *timings)
        if (timing.name == label) ms += timing.ms;
    return ms;
}

uint32_t lanesOf(const BenchOptions& options) { return options.group_size == 0 ? GROUP_SIZE : options.group_size; }

gpu::vec4 wordsOf(const brittle::Double3& p, float w) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), w};
}

brittle::Double3 xyz(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

} // namespace bench
