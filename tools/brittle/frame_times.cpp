#include "tools/brittle/frame_times.h"

#include "modules/brittle/mesh/format.h"

#include <cmath>
#include <cstdint>

namespace cli {
namespace {

constexpr double kSame = 1e-6; // of a frame: nearer moments are one
constexpr double kMostFrames = 1e6;

} // namespace

engine::Result<std::vector<double>> frameTimes(double seconds, double fps) {
    const double last = std::floor(seconds * fps + kSame);
    if (last >= kMostFrames)
        return engine::Error{engine::ErrorCode::BadInput, brittle::formatNumber(seconds) + " s at " +
                                                              brittle::formatNumber(fps) +
                                                              " frames a second are more than a million frames; ask for fewer"};
    std::vector<double> times;
    for (uint32_t k = 0; k <= static_cast<uint32_t>(last); ++k)
        times.push_back(k / fps);
    return times;
}

engine::Result<std::vector<double>> frameTimesAndEnd(double seconds, double fps) {
    auto times = frameTimes(seconds, fps);
    if (!times) return times;
    if (seconds - times->back() > kSame / fps) times->push_back(seconds);
    times->back() = seconds;
    return times;
}

} // namespace cli
