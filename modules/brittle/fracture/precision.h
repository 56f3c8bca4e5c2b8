// How the signs are found that decide which cell a point lies in. What is not exact may get close cases wrong, and ties always:
// cells then disagree, and the event fails, or its fragments break their contract.
#pragma once

#include <cstdint>

namespace brittle {

enum class Precision : uint8_t {
    Exact,  // in integers, ties by the ids of sites; cells that the filter leaves in doubt are done again
    Double, // the same determinants in fp64; needs a device with shaderFloat64
    Fast,   // in fp32
};

constexpr const char* nameOf(Precision precision) {
    return precision == Precision::Exact ? "exact" : (precision == Precision::Double ? "double" : "fast");
}

} // namespace brittle
