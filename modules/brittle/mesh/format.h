// Numbers in messages.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <cstdio>
#include <string>
#include <vector>

namespace brittle {

inline std::string formatNumber(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

inline std::string formatPoint(const Double3& p) {
    return "(" + formatNumber(p[0]) + ", " + formatNumber(p[1]) + ", " + formatNumber(p[2]) + ")";
}

// "1 edge", "2 edges"; "1 vertex", "2 vertices".
inline std::string formatCount(uint64_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}
inline std::string formatCount(uint64_t count, const std::string& one) { return formatCount(count, one, one + "s"); }

// The first few, parted by commas.
inline std::string formatList(const std::vector<std::string>& names) {
    constexpr size_t kMost = 3;
    std::string list;
    for (size_t k = 0; k < names.size() && k < kMost; ++k)
        list += (k > 0 ? ", " : "") + names[k];
    return names.size() > kMost ? list + ", ..." : list;
}

} // namespace brittle
