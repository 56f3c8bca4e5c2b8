// A criterion that is out of reach is kept: its test says KNOWN SHORTFALL with what was measured, and fails once it is met, so
// that nobody goes on calling it one.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>

namespace support {

inline void knownShortfall(const char* what, double measured, double allowed) {
    std::printf("KNOWN SHORTFALL: %s is %g, allowed are %g\n", what, measured, allowed);
    EXPECT_GT(measured, allowed) << "the criterion is met now: make it an ordinary one";
}

} // namespace support
