// `brittle bench`: what cells and whole shatters cost, and what others take for the same on the same machine in the same run.
//
// Ours and the peer's runs alternate, so that a machine that is busy for a while is busy for both, and medians are reported.
// Peers run on one thread; we run on the device, which on a CPU device means all its threads.
#pragma once

#include "engine/device.h"
#include "engine/result.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bench {

struct BenchOptions {
    std::vector<uint32_t> cell_counts = {100, 1'000, 10'000, 100'000}; // sites in a cube
    std::vector<uint32_t> shatter_counts = {10, 100, 1'000};           // sites in the bumpy sphere
    uint32_t sphere_level = 5;                                         // 20 * 4^level triangles
    uint32_t peer_shatter_limit = 100;                                 // CGAL runs up to here
    uint32_t rounds = 5;
    uint64_t seed = 1;
};

// Called with one line before each step.
using Progress = std::function<void(const std::string&)>;

engine::Result<nlohmann::json> runBench(engine::Device& device, const BenchOptions& options, const Progress& progress);

// The parts of the above.
engine::Result<nlohmann::json> benchCells(engine::Device& device, const BenchOptions& options, const Progress& progress);
engine::Result<nlohmann::json> benchShatter(engine::Device& device, const BenchOptions& options, const Progress& progress);

double median(std::vector<double> samples); // 0 of none

} // namespace bench
