// Three doubles at a time; what the host's mesh code needs of it and no more.
#pragma once

#include "modules/brittle/mesh/mesh.h"

#include <cmath>

namespace brittle {

inline Double3 operator+(const Double3& a, const Double3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Double3 operator-(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Double3 operator*(double s, const Double3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Double3& operator+=(Double3& a, const Double3& b) { return a = a + b; }
inline double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Double3 cross(const Double3& a, const Double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Double3& a) { return std::sqrt(dot(a, a)); }
inline bool isFinite(const Double3& a) { return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]); }

inline Double3 toDouble(const Float3& a) {
    return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}
inline Float3 toFloat(const Double3& a) {
    return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

// Of unit length, or `fallback` where there is no direction.
inline Double3 normalized(const Double3& a, const Double3& fallback) {
    const double size = length(a);
    return size > 0 && std::isfinite(size) ? (1 / size) * a : fallback;
}

struct Box {
    Double3 lower = {1e300, 1e300, 1e300};
    Double3 upper = {-1e300, -1e300, -1e300};
    void grow(const Double3& p) {
        for (size_t c = 0; c < 3; ++c) {
            lower[c] = p[c] < lower[c] ? p[c] : lower[c];
            upper[c] = p[c] > upper[c] ? p[c] : upper[c];
        }
    }
    double diagonal() const { return length(upper - lower); }
};

} // namespace brittle
