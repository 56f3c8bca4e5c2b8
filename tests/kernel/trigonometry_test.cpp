// Sine and cosine of kernels against those of the host in double precision.
#include "tests/kernel/lab.h"

#include <cmath>
#include <numbers>
#include <random>

namespace kernel_test {
namespace {

struct Vec2 {
    float x, y;
};

std::vector<Vec2> onDeviceOf(const std::vector<float>& angles) {
    const engine::Buffer in = bufferOf(angles), out = blankBuffer<Vec2>(angles.size());
    const auto count = static_cast<uint32_t>(angles.size());
    onDevice([&](engine::Commands& commands) { commands.dispatch(testKernel("angles"), count, count, {in, out}); });
    return valuesOf<Vec2>(out, angles.size());
}

// Draws angles of both signs, evenly over the exponents of floats.
std::vector<float> anglesUpTo(double most, size_t count) {
    std::mt19937 random(7);
    std::vector<float> angles = {0.0f, -0.0f, 1e-30f, static_cast<float>(most)};
    while (angles.size() < count) {
        const double share = static_cast<double>(random()) / 4294967296.0;
        const double size = 1e-8 * std::pow(most / 1e-8, share);
        angles.push_back(static_cast<float>(random() % 2 == 0 ? size : -size));
    }
    return angles;
}

constexpr double kRounding = 1.0 / (1 << 22);

TEST(SmallTrigonometry, OfSmallAnglesIsRightToRounding) {
    for (const uint32_t count : kSizes) {
        const std::vector<float> angles = anglesUpTo(0.78, std::max(count, 4u));
        const std::vector<Vec2> results = onDeviceOf(angles);
        for (size_t k = 0; k < angles.size(); ++k) {
            const double sine = std::sin(double(angles[k])), cosine = std::cos(double(angles[k]));
            ASSERT_LE(std::abs(results[k].x - sine), kRounding * std::abs(sine)) << angles[k];
            ASSERT_LE(std::abs(results[k].y - cosine), kRounding * std::abs(cosine)) << angles[k];
        }
    }
}

// Near a multiple of a quarter turn the reduced angle is as exact as the parts of pi/2 are: 2^-45 for each quarter.
TEST(SmallTrigonometry, OfLargeAnglesIsRightUpToTenThousandRadians) {
    std::vector<float> angles = anglesUpTo(1e4, 20000);
    for (int quarters = -12; quarters <= 12; ++quarters)
        angles.push_back(static_cast<float>(quarters * 0.5 * std::numbers::pi));
    const std::vector<Vec2> results = onDeviceOf(angles);
    for (size_t k = 0; k < angles.size(); ++k) {
        const double slack = 1e-9 + std::abs(double(angles[k])) * 1e-13;
        const double sine = std::sin(double(angles[k])), cosine = std::cos(double(angles[k]));
        ASSERT_LE(std::abs(results[k].x - sine), kRounding * std::abs(sine) + slack) << angles[k];
        ASSERT_LE(std::abs(results[k].y - cosine), kRounding * std::abs(cosine) + slack) << angles[k];
    }
}

} // namespace
} // namespace kernel_test
