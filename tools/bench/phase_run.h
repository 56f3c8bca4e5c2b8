// What the benches of single phases of a step share: random numbers, buffers, and device time by label.
#pragma once

#include "engine/commands.h"
#include "modules/brittle/dynamics/world_contents.h"
#include "tools/bench/bench.h"

#include <random>

namespace bench {

// The same numbers everywhere: the standard says what the engine draws, but not what its distributions make of it.
class Dice {
public:
    explicit Dice(uint64_t seed) : engine_(seed) {}
    double between(double lower, double upper) {
        return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    size_t below(size_t count) { return static_cast<size_t>(between(0, static_cast<double>(count))); }
    brittle::Double3 inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    brittle::Turn turn(); // unit, evenly over all turns

private:
    std::mt19937_64 engine_;
};

// Buffers until one cannot be made.
class Buffers {
public:
    explicit Buffers(engine::Device& device) : device_(device) {}
    engine::Buffer make(uint64_t bytes, std::string_view name);
    engine::Result<void> status() const { return status_; }

private:
    engine::Device& device_;
    engine::Result<void> status_;
};

// Milliseconds of device time under this label; the commands have been waited for.
engine::Result<double> labelMs(const engine::Commands& commands, std::string_view label);

uint32_t lanesOf(const BenchOptions& options);

// Of a vertex, a corner of a box or a place, as the kernels read it.
gpu::vec4 wordsOf(const brittle::Double3& p, float w);
brittle::Double3 xyz(const gpu::vec4& v);

} // namespace bench
