#include "tools/bench/bench.h"

#include <algorithm>
#include <thread>

namespace bench {

double median(std::vector<double> samples) {
    if (samples.empty()) return 0;
    std::sort(samples.begin(), samples.end());
    const size_t n = samples.size();
    return n % 2 == 1 ? samples[n / 2] : (samples[n / 2 - 1] + samples[n / 2]) / 2;
}

engine::Result<nlohmann::json> runBench(engine::Device& device, const BenchOptions& options, const Progress& progress) {
    auto cells = benchCells(device, options, progress);
    if (!cells) return cells.error();
    auto shatters = benchShatter(device, options, progress);
    if (!shatters) return shatters.error();
    return nlohmann::json{
        {"device", device.name()},  {"driver", device.driver()},  {"cores", std::thread::hardware_concurrency()},
        {"rounds", options.rounds}, {"cells", std::move(*cells)}, {"shatter", std::move(*shatters)}};
}

} // namespace bench
