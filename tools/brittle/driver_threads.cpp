#include "tools/brittle/driver_threads.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

namespace cli {

void spreadDriverThreads() {
    constexpr unsigned kMostThreads = 16;
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    setenv("LP_NUM_THREADS", std::to_string(std::min(2 * cores, kMostThreads)).c_str(), /*overwrite=*/0);
}

} // namespace cli
