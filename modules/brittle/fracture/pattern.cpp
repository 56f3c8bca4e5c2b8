#include "modules/brittle/fracture/pattern.h"

#include <cmath>
#include <numbers>

namespace brittle {

double contactRadiusOf(double joules) {
    constexpr double kStored = 18e3; // joules in a cubic meter
    return std::cbrt(3 * joules / (4 * std::numbers::pi * kStored));
}

double favorOf(double joules) { return 1 - std::exp2(-joules); }

} // namespace brittle
